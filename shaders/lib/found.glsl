// What the scene's own text finds at a point, and what that is made of.

// A material at a point of a surface: its pattern looked up.
struct Look {
    vec4 color;  // w: Ka
    vec4 phong;  // Kd, Ks, Kr, C
#ifdef MATERIAL_EXTRA
    mat2x4 extra;
#endif
};
Look mixed(Look a, Look b, float share) {
#ifdef MATERIAL_EXTRA
    return Look(mix(a.color, b.color, share), mix(a.phong, b.phong, share), a.extra * (1.0 - share) + b.extra * share);
#else
    return Look(mix(a.color, b.color, share), mix(a.phong, b.phong, share));
#endif
}

struct Nearest {
    float distance;
    int leaf;    // whose surface it is; -1: none
    vec3 at;     // the point in that leaf's frame
#ifdef EFFECT_BLEND
    Look look;   // of all the leaves that show there, each by its share
#endif
};

// A field of one metre of a checkerboard in the leaf's frame. The point is moved a little, so that a surface that lies on
// a border of two fields (a floor at height 0) falls into one of them everywhere.
const float FIELD_INSET = 1e-3;
bool isDarkField(vec3 p) {
    vec3 field = floor(p - FIELD_INSET);
    return mod(field.x + field.y + field.z, 2.0) != 0.0;
}

Look lookOf(int leaf, vec3 at) {
    Material material = materialRecord(int(leafRecord(max(leaf, 0)).position.w));
    vec3 color = material.color.rgb;
#ifdef EFFECT_CHECKER
    uses(EFFECT_CHECKER, 1);
    if (material.phong.w != 0.0 && isDarkField(at)) color = material.color2.rgb;
#endif
#ifdef MATERIAL_EXTRA
    return Look(vec4(color, material.color.w), vec4(material.color2.w, material.phong.xyz), material.extra);
#else
    return Look(vec4(color, material.color.w), vec4(material.color2.w, material.phong.xyz));
#endif
}
#ifdef EFFECT_BLEND
Look lookOf(Nearest found) { return found.look; }
#else
Look lookOf(Nearest found) { return lookOf(found.leaf, found.at); }
#endif

Nearest foundLeaf(float distance, int leaf, vec3 at) {
#ifdef EFFECT_BLEND
    return Nearest(distance, leaf, at, lookOf(leaf, at));
#else
    return Nearest(distance, leaf, at);
#endif
}

// Of values that differ by no more than this, which is rounding, the first is nearer: faces that lie in one plane are computed
// from other centres. Set where a ray arrives.
float tie = 0.0;

// What a march keeps: no more than whose the surface is.
struct Lead {
    float distance;
    int leaf;
};
Lead nearer(Lead a, Lead b) { return Lead(min(a.distance, b.distance), b.distance < a.distance - tie ? b.leaf : a.leaf); }
Lead foundBoth(float distance, float share, Lead a, Lead b) { return Lead(distance, share > 0.5 ? b.leaf : a.leaf); }

// The nearer of two.
Nearest nearer(Nearest a, Nearest b) {
    Nearest first = a;
    if (b.distance < a.distance - tie) first = b;
    first.distance = min(a.distance, b.distance);
    return first;
}
// Two under an operator: its value, and how much of the second shows.
Nearest foundBoth(float distance, float share, Nearest a, Nearest b) {
    Nearest both = a;
    if (share > 0.5) both = b;
    both.distance = distance;
#ifdef EFFECT_BLEND
    uses(EFFECT_BLEND, 1);
    both.look = mixed(a.look, b.look, share);
#endif
    return both;
}
