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
    s.normal = normalAt(s.position, s.travelled, march.side, ray.direction);

    Nearest found = nearest(s.position);
    count(NORMAL, 1);
    Look look = lookOf(found);
    s.object = found.leaf < 0 ? -1.0 : leafRecord(found.leaf).extra.y;
    s.color = look.color.rgb;
    s.ambient = look.color.w;
    s.diffuse = look.phong.x;
    s.specular = look.phong.y;
    s.reflectance = look.phong.z;
    s.shininess = look.phong.w;
    return s;
}

const float LEAST_WEIGHT = 1.0 / 512.0;  // a reflection fainter than half a step of an 8-bit picture is not followed

Ray reflectRay(Ray ray, Surface s) {
    vec3 direction = normalize(reflect(ray.direction, s.normal));
    return Ray(s.position + s.normal * biasAt(s.travelled), direction, s.travelled);
}
