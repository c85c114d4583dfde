// The surface a ray met, and what it is made of.

struct Surface {
    vec3 position;
    vec3 normal;
    float travelled;     // metres from the eye, along the path
    float object;
    vec3 color;
    float ambient, diffuse, specular, shininess, reflectance;
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
    s.normal = normalAt(s.position, s.travelled, march.side, ray.direction);
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
    return s;
}

const float LEAST_WEIGHT = 1.0 / 512.0;  // a reflection fainter than half a step of an 8-bit picture is not followed

// The reflected ray starts on its own line, as far along it as brings it a bias away from the surface: a start moved along
// the normal would be another ray, and between mirrors the shifts add up. A flat one is moved along the normal as well.
Ray reflectRay(Ray ray, Surface s) {
    vec3 direction = normalize(reflect(ray.direction, s.normal));
    float bias = biasAt(s.travelled), rise = dot(direction, s.normal);
    float along = bias / max(rise, 0.25);
    return Ray(s.position + direction * along + s.normal * (bias - along * rise), direction, s.travelled + along);
}
