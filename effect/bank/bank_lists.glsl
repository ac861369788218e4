// The lists of regions for pass C of `bank`, from what pass A has noted of its tiles. docs/scatter.md. Included by pass B. Uses
// bank.glsl, and `threads` of the pass's workgroup, each of which lists one region.

shared uint listed[2]; // regions of this workgroup on each list; then where they begin there

// Makes room for `count` regions at the end of a list, and its pipeline's dispatch cover them. Returns the first's place.
uint extendList(int kind, uint count) {
    if (listCapacity(kind) <= bankDispatchWidth) { // one row: its width counts
        return atomicAdd(dispatches[kind].x, count);
    }
    uint first = atomicAdd(dispatches[kind].count, count);
    if (count > 0u) {
        atomicMax(dispatches[kind].x, min(first + count, bankDispatchWidth));
        atomicMax(dispatches[kind].y, (first + count - 1u) / bankDispatchWidth + 1u);
    }
    return first;
}

// The bits of tileStepBit that count for the upper or lower part of a tile, of a tile that lies so far from there: in the tile
// itself half of its quads and the row next to them, in those around what lies beside that.
//
//   groups of rows that count     tile above    the tile      tile below
//   upper part                    5             0 1 2 3       none
//   lower part                    none          2 3 4 5       0
//
//   groups of columns             tile left     the tile      tile right
//   of either part                2             0 1 2         0
uint stepBitsBeside(ivec2 tile, bool lower) {
    uint columns = tile.x == 0 ? 7u : tile.x == -1 ? 4u : tile.x == 1 ? 1u : 0u; // a bit a group
    // An octal digit a group, the first one last: 1 where it counts. Times `columns` the digits become those bits.
    uint rows[3] = lower ? uint[](0u, 0111100u, 1u) : uint[](0100000u, 01111u, 0u);
    return rows[tile.y + 1] * columns << 1;
}

// What combines a region: bits of its parts that are edge regions, and of those in which no pixel has a material; the rest is a
// smooth one.
struct Combination {
    uint edges;
    uint empty;
    uint occupied; // ListEntry
};

const Combination emptyCombination = Combination(0u, 15u, 0u);

Combination combinationOf(ivec2 region) {
    ivec2 first = region * ivec2(2, 1);
    uint stepped = 0u;
    uint occupied = 0u;
    [[unroll]] for (int i = 0; i < 12; ++i) {
        ivec2 place = ivec2(i % 4, i / 4) - 1;
        ivec2 tile = first + place;
        uint entry = isInLevel(tileLevels, tile) ? tileEntries[tileIndex(tile)] : 0u;
        occupied |= (entry & tileOccupied) != 0u ? occupiedBit(place + 1) | entry & tileBright : 0u;
        [[unroll]] for (int part = 0; part < 4; ++part) {
            stepped |= (entry & stepBitsBeside(place - ivec2(part & 1, 0), part > 1)) != 0u ? 1u << part : 0u;
        }
    }
    uint empty = ((occupied & occupiedBit(ivec2(1))) == 0u ? 5u : 0u) | ((occupied & occupiedBit(ivec2(2, 1))) == 0u ? 10u : 0u);
    stepped &= ~empty;
    // Where materials are separate, pixels are combined tap by tap.
    bool noneSmooth = separateMaterials || bitCount(stepped) > bankMostEdgeParts;
    return Combination(noneSmooth ? 15u & ~empty : stepped, empty, occupied);
}

void storeListEntry(int place, ListEntry entry) {
    tileEntries[place] = packPart(entry);
    tileEntries[place + 1] = entry.occupied;
}

// A region a thread; `group`: of those that list.
void listRegions(int group, int thread) {
    if (thread < 2) {
        listed[thread] = 0u;
    }
    barrier();
    ivec2 regions = regionCount();
    int index = group * threads + thread;
    ivec2 region = ivec2(index % regions.x, index / regions.x);
    Combination combination = region.y < regions.y ? combinationOf(region) : emptyCombination;
    uint skipped = combination.edges | combination.empty;
    bool smoothRest = skipped != 15u;
    uint smoothPlace = smoothRest ? atomicAdd(listed[0], 1u) : 0u;
    uint edgePlace = combination.edges != 0u ? atomicAdd(listed[1], uint(bitCount(combination.edges))) : 0u;
    barrier();
    if (thread < 2) {
        listed[thread] = extendList(thread, listed[thread]);
    }
    barrier();
    if (smoothRest) {
        storeListEntry(listPlace(0, listed[0] + smoothPlace), ListEntry(2 * region, skipped, combination.occupied));
    }
    uint entry = listed[1] + edgePlace;
    for (uint edges = combination.edges; edges != 0u; edges &= edges - 1u) {
        int part = findLSB(edges);
        ivec2 offset = ivec2(part & 1, part >> 1);
        storeListEntry(listPlace(1, entry++), ListEntry(2 * region + offset, 0u, combination.occupied >> offset.x & edgeReads));
    }
}
