// The grid of src/core/sdf/grid.h: the cell a point lies in, and the records its items name. In buffer textures, since
// a scene of thousands outgrows a uniform block.

#include "lib/ahead.glsl"

uniform usamplerBuffer grid_cells;  // of each cell, in blocks of BRICK³ a coarse one: what is empty around its middle
uniform usamplerBuffer grid_lists;  // of each cell: its first item
uniform usamplerBuffer grid_items;  // x: code, how it is joined, whether it is the last, record; y: the record of what joins it
const uint NO_ITEMS = 0xFFFFFFFFu;
const uint WHOLE = 1u;              // a flag of a cell's word: what it says is the whole coarse cell's; the rest is a float
const int BRICK = 4;                // cells along a coarse one's side

struct Cell {
    int first;        // its first item; -1: it has none
    float safe;       // no surface is nearer than this, unless an item says so
    bool empty;       // no surface crosses it
    bool outside;     // of the grid
    vec3 middle;      // of the cell, or outside of all that has bounds, relative to the eye
    vec3 half_sides;
};

// Where a point lies: in cells from the grid's corner.
struct Spot {
    vec3 at;
    ivec3 cell;
    int index;
    bool outside;
};
float cellSize() { return frame.grid_corner.w / float(BRICK); }
Spot spotAt(vec3 at) {
    ivec3 cell = ivec3(floor(at)), inside = clamp(cell, ivec3(0), max(frame.grid_size.xyz * BRICK - 1, 0));
    ivec3 coarse = inside >> 2, k = inside & 3;
    int index = ((coarse.z * frame.grid_size.y + coarse.y) * frame.grid_size.x + coarse.x) * BRICK * BRICK * BRICK + (k.z * BRICK + k.y) * BRICK + k.x;
    return Spot(at, cell, index, cell != inside || frame.grid_size.x == 0);
}
// The middle of what the word is about, in cells; and the distance that is empty around it, 0 where a surface may cross.
vec3 middleOf(Spot spot, uint word) {
    return (word & WHOLE) != 0u ? vec3((spot.cell & ~3) + BRICK / 2) : vec3(spot.cell) + 0.5;
}
float ballOf(uint word) { return uintBitsToFloat(word & ~WHOLE); }

Cell cellOf(Spot spot, uint word, vec3 p) {
    // Beyond the grid are the parts without bounds; all else is as near as its box, at least.
    if (spot.outside) {
        vec3 out_of = max(max(frame.box_lo.xyz - p, p - frame.box_hi.xyz), 0.0);
        return Cell(frame.grid_size.w == 0 ? -1 : 0, length(out_of), frame.grid_size.w == 0, true, 0.5 * (frame.box_lo.xyz + frame.box_hi.xyz),
                    0.5 * (frame.box_hi.xyz - frame.box_lo.xyz));
    }
    uint first = texelFetch(grid_lists, spot.index).x;
    vec3 middle = frame.grid_corner.xyz + middleOf(spot, word) * cellSize();
    bool none = first == NO_ITEMS;
    return Cell(none ? -1 : int(first), none ? ballOf(word) - length(p - middle) : EMPTY, ballOf(word) > 0.0, false, middle,
                vec3(((word & WHOLE) != 0u ? 0.5 : 0.5 / float(BRICK)) * frame.grid_corner.w));
}
Cell cellAt(vec3 p) {
    Spot spot = spotAt((p - frame.grid_corner.xyz) * frame.box_lo.w);
    return cellOf(spot, texelFetch(grid_cells, spot.index).x, p);
}

// How far from p along d the cell's list is all there is; outside, how far it is to the grid. A list holds a little beyond
// its cell (GridBuilder::radius), and a ray that leaves is to land in the next.
const float BEYOND_CELL = 1.0005;
float freeIn(Cell cell, vec3 p, vec3 d) {
    vec2 span = spanAround(p - cell.middle, d, cell.half_sides * BEYOND_CELL);
    return cell.outside ? aheadOnly(span).x : max(span.y, 0.0);
}

// From where on a ray may meet anything: the grid's box, where nothing lies outside.
float enterScene(vec3 o, vec3 d) {
    if (frame.grid_size.w != 0) return 0.0;
    return aheadOnly(spanAround(o - 0.5 * (frame.box_lo.xyz + frame.box_hi.xyz), d, 0.5 * (frame.box_hi.xyz - frame.box_lo.xyz))).x;
}

// From t along a ray to the first cell that a surface crosses, or to `far`; `cell` is the one t comes to lie in. The ball of
// emptiness around an empty cell's middle holds the cell; `back` is how far it reaches behind t.
const int SKIP_CAP = 4096;
float skipEmpty(vec3 o, vec3 d, float t, float far, bool skips, out Cell cell, out float back) {
    vec3 origin = (o - frame.grid_corner.xyz) * frame.box_lo.w, direction = d * frame.box_lo.w;
    bool nothing_outside = frame.grid_size.w == 0, arrived = false;
    Spot spot;
    uint word;
    back = 0.0;
    for (int i = 0; i < SKIP_CAP; ++i) {
        spot = spotAt(origin + direction * t);
        word = texelFetch(grid_cells, spot.index).x;
        float ball = spot.outside ? 0.0 : ballOf(word);
        arrived = !skips || t >= far || !(spot.outside ? nothing_outside : ball > 0.0);
        if (arrived) break;
        vec2 span = spanBall((spot.at - middleOf(spot, word)) * cellSize(), d, ball);
        if (i == 0) back = spot.outside ? 0.0 : max(-span.x, 0.0);
        t = spot.outside ? far : t + max(span.y, 0.0);
    }
    if (!arrived) cut_short = true;
    cell = cellOf(spot, word, o + d * t);
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

// What the scene's items say of a point and a direction (written by src/core/render/grid_glsl.cpp); and of these: the distance,
// how far on all is empty, and 1 if that is where something may begin.
float lookAhead(vec3 p, vec3 d, Cell cell, out int leaf, out Ahead ahead);
vec3 mapAhead(vec3 p, vec3 d, Cell cell, out int leaf) {
    Ahead ahead;
    float f = lookAhead(p, d, cell, leaf, ahead), exit = freeIn(cell, p, d);
    return vec3(f, min(ahead.span.x, exit), ahead.span.x < exit ? 1.0 : 0.0);
}
