// What a surface sends back along a ray: the ambient light, and what the scene's effects add to it. Sums are made as they are
// written, whatever else stands in the text, so that an effect's presence changes no other's rounding.

vec3 phong(Surface s, vec3 direction) {
#ifdef SHADED
    AS_WRITTEN vec3 around = s.ambient * s.color;
#else
    vec3 around = s.ambient * s.color;  // to which nothing is added; AS_WRITTEN would hold all that it is computed from
#endif
#effects around
    vec3 color = isFirstPass() ? around : vec3(0.0);
#effects lights
    return color;
}
