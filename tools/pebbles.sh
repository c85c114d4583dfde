#!/bin/sh
# Prints saves/pebbles.txt: 400 different pebbles on a patch whose opposite edges meet, to be repeated 5 by 5.
#   tools/pebbles.sh > saves/pebbles.txt
# The largest are laid first, each where it overlaps no other by more than a little. The generator of the numbers is its own.
exec awk '
function uniform() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
function apart(a, b) { a = a > b ? a - b : b - a; return a > side / 2 ? side - a : a }
function short(x, format, s) {
    s = sprintf(format, x)
    if (s ~ /\./) { sub(/0+$/, "", s); sub(/\.$/, "", s) }
    sub(/^0\./, ".", s); sub(/^-0\./, "-.", s)
    return s == "-0" || s == "" ? "0" : s
}
BEGIN {
    seed = 20011; side = 4; n = 400; kinds = 5
    print "marchbox 1"
    print "# Ten thousand pebbles: a patch of 400, no two alike, repeated 5 by 5. Laid by tools/pebbles.sh, whose output this is."
    print "world background:0.6,0.72,0.84"
    print "camera eye:0.6,2.7,9.4 target:0,0,5.6 fov:48"
    print "light name:sun pos:-14,12,-4 color:1,0.94,0.84 intensity:0.95"
    print "light pos:10,14,16 color:0.6,0.7,0.9 intensity:0.25"
    print "material name:sand color:0.56,0.49,0.39 Ka:0.2 Kd:0.7 Ks:0"
    print "material name:slate color:0.34,0.36,0.4 Ka:0.18 Kd:0.7 Ks:0.2"
    print "material name:chalk color:0.82,0.8,0.74 Ka:0.18 Kd:0.7 Ks:0.15"
    print "material name:rust color:0.6,0.36,0.26 Ka:0.18 Kd:0.7 Ks:0.15"
    print "material name:moss color:0.46,0.47,0.36 Ka:0.18 Kd:0.7 Ks:0.15"
    print "material name:flint color:0.55,0.52,0.5 Ka:0.18 Kd:0.7 Ks:0.25"
    print "render samples:2"
    print "object name:sand type:plane material:sand"
    print "object name:beach type:repeat cell:4,0,4 count:5,1,5"
    print "  object type:union"
    split("slate chalk rust moss flint", name, " ")
    for (i = 0; i < n; ++i) {
        r = 0.172 * exp(-1.35 * i / n)
        do {
            x = side * uniform(); z = side * uniform(); free = 1
            for (j = 0; j < i && free; ++j) {
                dx = apart(x, px[j]); dz = apart(z, pz[j]); reach = 0.92 * (r + pr[j])
                free = dx * dx + dz * dz >= reach * reach
            }
        } while (!free && ++tries < 2000000)
        px[i] = x; pz[i] = z; pr[i] = r
        flat = 0.55 + 0.25 * uniform(); narrow = 0.7 + 0.3 * uniform(); turn = 360 * uniform(); tilt = 16 * uniform() - 8
        kind = int(kinds * uniform()) + 1
        line[kind] = line[kind] "      object type:ellipsoid pos:" short(x - side / 2, "%.3f") "," short(0.6 * flat * r, "%.3f") "," \
            short(z - side / 2, "%.3f") " rot:0," short(turn, "%.0f") "," short(tilt, "%.0f") " radii:" short(r, "%.3f") "," \
            short(flat * r, "%.3f") "," short(narrow * r, "%.3f") "\n"
    }
    for (k = 1; k <= kinds; ++k) printf "    object type:union material:%s\n%s", name[k], line[k]
}'
