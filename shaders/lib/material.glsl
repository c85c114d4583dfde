// The surface a ray met, and what it is made of.

struct Surface {
    vec3 position;
    vec3 normal;
    float travelled;     // metres from the eye, along the path
    float object;
    vec3 color;
    float ambient, diffuse, specular, shininess, reflectance;
};

// A field of one metre of a checkerboard in the leaf's frame. The point is moved a little into the solid, so that a
// surface that lies on a border of two fields (a floor at height 0) falls into one of them everywhere.
bool isDarkField(vec3 p) {
    vec3 field = floor(p);
    return mod(field.x + field.y + field.z, 2.0) != 0.0;
}
const float FIELD_INSET = 1e-3;

vec3 materialColor(Material material, vec3 p, vec3 normal, Leaf leaf) {
#ifdef EFFECT_CHECKER
    if (material.phong.w != 0.0 && isDarkField(local(p - normal * FIELD_INSET, leaf))) return material.color2.rgb;
#endif
    return material.color.rgb;
}

Surface surfaceAt(Ray ray, March march) {
    Surface s;
    s.position = ray.origin + ray.direction * march.t;
    s.travelled = ray.travelled + march.t;
    s.normal = normalAt(s.position, s.travelled, march.side, ray.direction);

    Nearest found = nearest(s.position);
    outcome.evaluations.y += 1;
    Leaf leaf = leaves[max(found.leaf, 0)];
    Material material = materials[int(leaf.position.w)];
    s.object = leaf.extra.y;
    s.color = materialColor(material, s.position, s.normal, leaf);
    s.ambient = material.color.w;
    s.diffuse = material.color2.w;
    s.specular = material.phong.x;
    s.reflectance = material.phong.y;
    s.shininess = material.phong.z;
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
