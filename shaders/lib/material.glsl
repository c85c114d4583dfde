// The surface a ray met, and what it is made of.

struct Surface {
    vec3 position;
    vec3 normal;         // where nothing shades: of an undecided ray's only
    float travelled;     // metres from the eye, along the path
    float object;
    vec3 color;
    float ambient, diffuse, specular, shininess, reflectance;
    Look look;           // the same, with what effects add
};

Surface surfaceAt(Ray ray, March march) {
    Surface s;
    s.position = ray.origin + ray.direction * march.t;
    s.travelled = ray.travelled + march.t;
#ifdef LEAF_SURFACE
    // Every surface is one leaf's own, and the march has found whose.
    Node node = leafRecord(max(march.leaf, 0));
    vec3 at = local(s.position, node);
    s.normal = leafNormal(at, node, normalReach(s.travelled), ray.direction);
    Look look = lookOf(march.leaf, at);
    s.object = march.leaf < 0 ? -1.0 : node.x_axis.w;
#else
#ifdef SHADED
    bool asked = true;
#else
    bool asked = march.state != HIT;  // by hasInside() alone
#endif
    s.normal = normalAt(s.position, s.travelled, march.side, ray.direction, asked);
    tie = noiseAt(s.travelled);
    Nearest found = nearest(s.position);
    count(NORMAL, 1);
    Look look = lookOf(found);
    s.object = found.leaf < 0 ? -1.0 : leafRecord(found.leaf).x_axis.w;
#endif
    s.color = look.color.rgb;
    s.ambient = look.color.w;
    s.diffuse = look.phong.x;
    s.specular = look.phong.y;
    s.reflectance = look.phong.z;
    s.shininess = look.phong.w;
    s.look = look;
    return s;
}

// Whether there is any solid at the surface an undecided ray came near. What is only joined has an inside wherever it has a
// surface; of a shape less itself the distance falls to 0 and rises again. Looked for across the surface, to one side and to
// the other, and along the ray (a thin wall seen from behind has a normal that lies across it): by secants, since a bound falls
// short of the way to go, and in steps that grow from below the rounding error, so that a thin sheet is not passed.
#ifdef CARVED
const int PROBES = 8;  // each way
bool hasInside(Surface s, March march, vec3 direction) {
    float f = march.closest, depth = 0.0, rate = 1.0;
    int asked = 0;
    for (int i = 0; i < 4 * PROBES; ++i) {
        if (march.state == HIT || f < 0.0) break;
        if (i % PROBES == 0) { f = march.closest; depth = 0.0; rate = 1.0; }
        float step = max(f / rate, 0.125 * noiseAt(s.travelled) * exp2(float(i % PROBES)));
        depth += step;
        float next = march.side * map(s.position + (i < 2 * PROBES ? s.normal : direction) * ((i / PROBES) % 2 == 0 ? -depth : depth));
        rate = (f - next) / step;
        if (rate < 0.0625) rate = 1.0;  // it rises, or hardly falls
        f = next;
        ++asked;
    }
    count(NORMAL, asked);
    return march.state == HIT || f < 0.0;
}
#else
bool hasInside(Surface s, March march, vec3 direction) { return true; }
#endif
