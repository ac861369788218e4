// The lists of regions for pass C of `bank`, from what pass A has noted of its tiles. bank_lists.glsl. Included by pass B.

// Regions of this workgroup on each list; then where they begin there.
var<workgroup> listed: array<atomic<u32>, 2>;

// Makes room for `count` regions at the end of a list, and its pipeline's dispatch cover them. Returns the first's place.
fn extendList(kind: i32, count: u32) -> u32 {
    if (listCapacity(kind) <= bankDispatchWidth) { // one row: its width counts
        return atomicAdd(&tiles.dispatches[kind].x, count);
    }
    let first = atomicAdd(&tiles.dispatches[kind].count, count);
    if (count > 0u) {
        atomicMax(&tiles.dispatches[kind].x, min(first + count, bankDispatchWidth));
        atomicMax(&tiles.dispatches[kind].y, (first + count - 1u) / bankDispatchWidth + 1u);
    }
    return first;
}

// The bits of tileStepBit that count for the upper or lower part of a tile, of a tile that lies so far from there
// (bank_lists.glsl).
fn stepBitsBeside(tile: vec2i, lower: bool) -> u32 {
    if (abs(tile.x) > 1) {
        return 0u;
    }
    const columns = array<u32, 3>(4u, 7u, 1u); // a bit a group
    // Three bits a group of rows: 1 where it counts.
    const upperRows = array<u32, 3>(0x8000u, 0x249u, 0u);
    const lowerRows = array<u32, 3>(0u, 0x9240u, 1u);
    let rows = select(upperRows[tile.y + 1], lowerRows[tile.y + 1], lower);
    return (rows * columns[tile.x + 1]) << 1u;
}

// What combines a region: bits of its parts that are edge regions, and of those in which no pixel has a material; the rest is a
// smooth one.
struct Combination {
    edges: u32,
    empty: u32,
    occupied: u32, // ListEntry
}

fn combinationOf(region: vec2i) -> Combination {
    var stepped = 0u;
    var occupied = 0u;
    for (var i = 0; i < 12; i++) {
        let place = vec2i(i % 4, i / 4) - 1;
        let tile = region * vec2i(2, 1) + place;
        if (!isInLevel(tileLevels, tile)) {
            continue;
        }
        let entry = tiles.entries[tileIndex(tile)];
        if ((entry & tileOccupied) != 0u) {
            occupied |= occupiedBit(place + 1) | (entry & tileBright);
        }
        for (var part = 0; part < 4; part++) {
            if ((entry & stepBitsBeside(place - vec2i(part & 1, 0), part > 1)) != 0u) {
                stepped |= 1u << u32(part);
            }
        }
    }
    let empty = select(0u, 5u, (occupied & occupiedBit(vec2i(1, 1))) == 0u) |
                select(0u, 10u, (occupied & occupiedBit(vec2i(2, 1))) == 0u);
    stepped &= ~empty;
    // Where materials are separate, pixels are combined tap by tap.
    let noneSmooth = separateMaterials || countOneBits(stepped) > u32(bankMostEdgeParts);
    return Combination(select(stepped, 15u & ~empty, noneSmooth), empty, occupied);
}

fn storeListEntry(place: i32, entry: ListEntry) {
    tiles.entries[place] = packPart(entry);
    tiles.entries[place + 1] = entry.occupied;
}

// A region a thread; `group`: of those that list. Three barriers.
fn listRegions(group: i32, thread: i32) {
    let regions = regionCount();
    let index = group * threads + thread;
    let region = vec2i(index % regions.x, index / regions.x);
    var combination = Combination(0u, 15u, 0u);
    if (region.y < regions.y) {
        combination = combinationOf(region);
    }
    let skipped = combination.edges | combination.empty;
    let smoothRest = skipped != 15u;
    var smoothPlace = 0u;
    var edgePlace = 0u;
    if (smoothRest) {
        smoothPlace = atomicAdd(&listed[0], 1u);
    }
    if (combination.edges != 0u) {
        edgePlace = atomicAdd(&listed[1], countOneBits(combination.edges));
    }
    workgroupBarrier();
    if (thread < 2) {
        atomicStore(&listed[thread], extendList(thread, atomicLoad(&listed[thread])));
    }
    workgroupBarrier();
    if (smoothRest) {
        storeListEntry(listPlace(0, atomicLoad(&listed[0]) + smoothPlace),
                       ListEntry(2 * region, skipped, combination.occupied));
    }
    var entry = atomicLoad(&listed[1]) + edgePlace;
    for (var part = 0; part < 4; part++) {
        if (((combination.edges >> u32(part)) & 1u) != 0u) {
            let offset = offsetOf(part);
            storeListEntry(listPlace(1, entry),
                           ListEntry(2 * region + offset, 0u, (combination.occupied >> u32(offset.x)) & edgeReads));
            entry++;
        }
    }
}
