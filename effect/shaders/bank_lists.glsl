// The lists of regions for pass C of `bank`, from what pass A has noted of its tiles. docs/scatter.md. Included by pass B,
// with `threads` of whose workgroups a region each.

shared uint listed[2]; // regions of this workgroup on each list; then where they begin there

// Makes room for `count` regions at the end of a list, and its pipeline's dispatch cover them. Returns the first's place.
uint extendList(int kind, uint count) {
    ivec2 regions = regionCount();
    if (uint(regions.x * regions.y) <= bankDispatchWidth) { // one row: its width counts
        return atomicAdd(dispatches[kind].x, count);
    }
    uint first = atomicAdd(dispatches[kind].count, count);
    if (count > 0u) {
        atomicMax(dispatches[kind].x, min(first + count, bankDispatchWidth));
        atomicMax(dispatches[kind].y, (first + count - 1u) / bankDispatchWidth + 1u);
    }
    return first;
}

// The bits of tileRough that count for a region, of its own tiles and of what lies beside it in those around. `place`:
// in tiles, from the region's first.
uint roughBeside(ivec2 place) {
    uint columns = place.x < 0 ? 0x124u : place.x > 1 ? 0x049u : 0x1ffu;
    uint rows = place.y < 0 ? 0x1c0u : place.y > 0 ? 0x007u : 0x1ffu;
    return (columns & rows) << 1;
}

// Whether a region holds pixels with a material, and whether it is rough: 0 smooth, 1 edge, -1 neither.
int kindOfRegion(ivec2 region) {
    ivec2 first = region * ivec2(2, 1);
    uint steps = 0u;
    uint occupied = 0u;
    [[unroll]] for (int i = 0; i < 12; ++i) {
        ivec2 place = ivec2(i % 4, i / 4) - 1;
        ivec2 tile = first + place;
        bool inside = tile == clamp(tile, ivec2(0), levelExtent(rawLevels) - 1);
        uint entry = inside ? tileEntries[tileIndex(tile)] : 0u;
        bool own = place.y == 0 && (place.x == 0 || place.x == 1);
        occupied |= own ? entry & tileOccupied : 0u;
        steps |= entry & roughBeside(place);
    }
    // Where materials are separate, pixels are combined tap by tap.
    return occupied == 0u ? -1 : separateMaterials || steps != 0u ? 1 : 0;
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
    int kind = region.y < regions.y ? kindOfRegion(region) : -1;
    uint place = 0u;
    if (kind >= 0) {
        place = atomicAdd(listed[kind], 1u);
    }
    barrier();
    if (thread < 2) {
        listed[thread] = extendList(thread, listed[thread]);
    }
    barrier();
    if (kind >= 0) {
        tileEntries[regionList(kind) + int(listed[kind] + place)] = uint(region.x | region.y << 16);
    }
}
