// The older form: two kinds of lines, without keywords, read through rows of their own.
#include "core/scene/text_reader.h"

#include <array>

namespace mb {
namespace {

struct OlderMaterial {
    double r = 0, g = 0, b = 0, ka = 0, kd = 0, ks = 0, kr = 0, c = 0;
};
struct OlderObject {
    int type = 0, material = 0;
    glm::dvec3 pos{0};
    double radius = 0, mass = 0;
};

/// The version 1 row of that name, which has the range.
template <class Record> const Key<Record>& row(std::string_view name) {
    for (const Key<Record>& key : keys<Record>())
        if (key.name == name) return key;
    std::abort();
}
/// A row of the older form, with the range of the row that it became.
template <class Older, class Record>
Key<Older> from(std::string_view name, double Older::*member, const Key<Record>& now, bool required = true) {
    return {.name = name, .member = member, .lo = now.lo, .hi = now.hi, .required = required};
}

constexpr double kLargest = 2.5e5;  // a radius of which every type makes lengths within their ranges
constexpr double kSmallest = 4e-6;

}  // namespace

template <> std::span<const Key<OlderMaterial>> keys() {
    const auto now = row<Material>;
    static const std::array<Key<OlderMaterial>, 8> rows{
        from("r", &OlderMaterial::r, now("color")),   from("g", &OlderMaterial::g, now("color")),
        from("b", &OlderMaterial::b, now("color")),   from("Ka", &OlderMaterial::ka, now("Ka")),
        from("Kd", &OlderMaterial::kd, now("Kd")),    from("Ks", &OlderMaterial::ks, now("Ks")),
        from("Kr", &OlderMaterial::kr, now("Kr"), false), from("C", &OlderMaterial::c, now("C"))};
    return rows;
}

template <> std::span<const Key<OlderObject>> keys() {
    const Key<Object>&pos = row<Object>("pos"), &mass = row<Object>("mass");
    static const std::array<Key<OlderObject>, 5> rows{{
        {.name = "type", .member = &OlderObject::type, .lo = 0, .hi = 2, .required = true},
        {.name = "material", .member = &OlderObject::material, .lo = 0, .hi = static_cast<double>(Limits::materials - 2), .required = true},
        {.name = "pos", .member = &OlderObject::pos, .lo = pos.lo, .hi = pos.hi, .required = true},
        {.name = "radius", .member = &OlderObject::radius, .lo = kSmallest, .hi = kLargest, .required = true},
        {.name = "mass", .member = &OlderObject::mass, .lo = mass.lo, .hi = mass.hi, .required = true}}};
    return rows;
}

namespace text {
namespace {

Material asMaterial(const OlderMaterial& m, std::size_t index) {
    Material out;
    out.name = fmt::format("material{}", index);
    out.color = {m.r, m.g, m.b};
    out.ka = m.ka, out.kd = m.kd, out.ks = m.ks, out.kr = m.kr, out.c = m.c;
    return out;
}

Object asObject(const OlderObject& o) {
    Object out;
    out.type = findShapeType(std::array{"sphere", "box", "torus"}[static_cast<std::size_t>(o.type)]);
    out.numbers = initialNumbers(*out.type);
    const double r = o.radius;
    if (o.type == 0) out.numbers[0] = r;
    else if (o.type == 1) out.numbers[0] = out.numbers[1] = out.numbers[2] = 2 * r;
    else out.numbers[0] = r, out.numbers[1] = r / 4;
    out.pos = o.pos, out.mass = o.mass;
    return out;
}

}  // namespace

void Reader::older(const Line& line) {
    const std::string_view key = line.pieces.front().key;
    const auto none = [](const Piece&) { return false; };
    if (line.indent > 0) {
        faults_.add(line.indent, "an indented line, expected none in a file without 'marchbox 1'");
    } else if (key == "r") {
        if (!room(line.indent, scene_.materials.size(), Limits::materials - 1, "materials")) return;  // one is the floor's
        OlderMaterial m;
        readKeys(faults_, "a material", line, 0, m, {}, none);
        scene_.materials.push_back(asMaterial(m, scene_.materials.size()));
    } else if (key == "type") {
        if (!room(line.indent, scene_.objects.size(), Limits::objects - 1, "objects")) return;
        OlderObject o;
        const std::size_t before = faults_.count();
        readKeys(faults_, "an object", line, 0, o, {}, none);
        if (faults_.count() != before) return;
        std::size_t at = 0;
        for (const Piece& p : line.pieces) if (p.key == "material") at = p.value.at;
        materials_meant_.push_back({scene_.objects.size(), faults_.place(at), {}, o.material});
        scene_.objects.push_back(asObject(o));
        scene_.objects.back().id = scene_.newId();
        object_places_.push_back(faults_.place(0)), children_.push_back(0);
    } else {
        faults_.add(line.indent, "a line of no known form, expected 'r:… g:… b:… …', 'type:… …', or 'marchbox 1' first");
    }
}

/// Materials are counted from 0, and may be defined further down.
void Reader::finishOlder() {
    const int count = static_cast<int>(scene_.materials.size());
    for (const Meant& meant : materials_meant_) {
        if (meant.index < count) scene_.objects[meant.object].material = meant.index;
        else faults_.add(meant.place, fmt::format("'material' is {}, expected one of the file's {}, counted from 0", meant.index, count));
    }
    addOlderDefaults();
}

/// What such a file could not say, and had.
void Reader::addOlderDefaults() {
    scene_.cameras.push_back({});
    scene_.lights.emplace_back().pos = {5, 10, 5};
    Material checker;
    checker.name = "floor", checker.color = glm::dvec3{0.9}, checker.color2 = glm::dvec3{0.1}, checker.pattern = Pattern::checker;
    Object floor;
    floor.id = scene_.newId();
    floor.name = "floor", floor.type = findShapeType("plane"), floor.numbers = initialNumbers(*floor.type);
    floor.material = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back(checker);
    scene_.objects.push_back(floor);
    object_places_.push_back({}), children_.push_back(0);
}

}  // namespace text
}  // namespace mb
