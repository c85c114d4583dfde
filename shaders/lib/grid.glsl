// The grid of src/core/sdf/grid.h: the cell a point lies in, and the records its items name. In buffer textures, since
// a scene of thousands outgrows a uniform block.

uniform usamplerBuffer grid_cells;  // x: the first item, or a brick's first cell; y: the distance at an empty cell's centre, or 0
uniform usamplerBuffer grid_items;  // x: code, how it is joined, whether it is the last, record; y: the record of what joins it
const uint NO_ITEMS = 0xFFFFFFFFu;
const uint BRICK_CELL = 0xFFFFFFFFu;
const int BRICK = 4;            // cells along its side

struct Cell {
    int first;        // its first item; -1: it has none
    float safe;       // no surface is nearer than this, unless an item says so
    float ball;       // of an empty one: around its middle there is nothing as far as this
    bool empty;       // no surface crosses it
    bool outside;     // of the grid
    vec3 middle;      // of the cell, or outside of all that has bounds, relative to the eye
    vec3 half_sides;
};

Cell cellAt(vec3 p) {
    vec3 at = (p - frame.grid_corner.xyz) / frame.grid_corner.w;
    ivec3 i = ivec3(floor(at));
    ivec3 inside = clamp(i, ivec3(0), max(frame.grid_size.xyz - 1, 0));
    uvec2 cell = texelFetch(grid_cells, (inside.z * frame.grid_size.y + inside.y) * frame.grid_size.x + inside.x).xy;
    vec3 middle = vec3(i) + 0.5;
    float half_side = 0.5;
    if (cell.y == BRICK_CELL) {
        ivec3 k = clamp(ivec3((at - vec3(i)) * float(BRICK)), ivec3(0), ivec3(BRICK - 1));
        middle = vec3(i) + (vec3(k) + 0.5) / float(BRICK);
        half_side = 0.5 / float(BRICK);
        cell = texelFetch(grid_cells, int(cell.x) + (k.z * BRICK + k.y) * BRICK + k.x).xy;
    }

    // Beyond the grid are the parts without bounds; all else is as near as its box, at least.
    if (i != inside) {
        vec3 out_of = max(max(frame.box_lo.xyz - p, p - frame.box_hi.xyz), 0.0);
        return Cell(frame.grid_size.w == 0 ? -1 : 0, length(out_of), 0.0, frame.grid_size.w == 0, true, 0.5 * (frame.box_lo.xyz + frame.box_hi.xyz),
                    0.5 * (frame.box_hi.xyz - frame.box_lo.xyz));
    }
    float ball = uintBitsToFloat(cell.y);
    vec3 centre = frame.grid_corner.xyz + middle * frame.grid_corner.w;
    bool none = cell.x == NO_ITEMS;
    return Cell(none ? -1 : int(cell.x), none ? ball - length(p - centre) : EMPTY, ball, cell.y != 0u, false, centre,
                vec3(half_side * frame.grid_corner.w));
}

// How far from p along d the cell's list is all there is; outside, how far it is to the grid. A list holds a little beyond
// its cell (GridBuilder::radius), and a ray that leaves is to land in the next.
const float BEYOND_CELL = 1.0005;
float freeIn(Cell cell, vec3 p, vec3 d) {
    vec2 span = spanAround(p - cell.middle, d, cell.half_sides * BEYOND_CELL);
    return cell.outside ? freeBefore(EMPTY, span) : max(span.y, 0.0);
}

// From where on a ray may meet anything: the grid's box, where nothing lies outside.
float enterScene(vec3 o, vec3 d) {
    if (frame.grid_size.w != 0) return 0.0;
    return freeBefore(EMPTY, spanAround(o - 0.5 * (frame.box_lo.xyz + frame.box_hi.xyz), d, 0.5 * (frame.box_hi.xyz - frame.box_lo.xyz)));
}

// From t along a ray to the first cell that a surface crosses, or to `far`; `cell` is the one t comes to lie in. The ball of
// emptiness around an empty cell's middle holds the cell; `back` is how far it reaches behind t.
const int SKIP_CAP = 4096;
float skipEmpty(vec3 o, vec3 d, float t, float far, bool skips, out Cell cell, out float back) {
    back = 0.0;
    for (int i = 0; i < SKIP_CAP; ++i) {
        cell = cellAt(o + d * t);
        if (!skips || !cell.empty || t >= far) break;
        vec2 ball = spanBall(o + d * t - cell.middle, d, cell.ball);
        if (i == 0 && !cell.outside) back = max(-ball.x, 0.0);
        t = cell.outside ? far : t + max(ball.y, 0.0);
    }
    if (skips && cell.empty && t < far) cut_short = true;
    return t;
}

struct Item {
    int code, how, record, joined;
    bool last;
};
Item itemAt(int i) {
    uvec2 item = texelFetch(grid_items, i).xy;
    return Item(int(item.x & 63u), int((item.x >> 6) & 15u), int(item.x >> 12), int(item.y), (item.x & 2048u) != 0u);
}
