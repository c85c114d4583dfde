// Objects: their type's own keys, their place in the tree, and what can only be told at the end of the file.
#include "core/scene/text_reader.h"
#include "core/sdf/tree.h"

#include <algorithm>
#include <cmath>

namespace mb::text {
namespace {

constexpr std::string_view kOwnKeys[] = {"type", "material"};  // of every object, beside the rows of keys<Object>()

const Piece* findPiece(const Line& line, std::string_view key) {
    for (const Piece& p : line.pieces)
        if (p.key == key) return &p;
    return nullptr;
}

/// The names of all types, for one to be suggested.
std::vector<std::string_view> typeNames() {
    std::vector<std::string_view> names;
    for (const Primitive& p : primitives()) names.push_back(p.name);
    for (const Operator& o : operators()) names.push_back(o.name);
    return names;
}

/// Whether any type at all has such a key.
bool someTypesKey(std::string_view key) {
    const auto has = [&](const ShapeType& t) {
        return std::any_of(t.parameters.begin(), t.parameters.end(), [&](const Parameter& p) { return p.name == key; });
    };
    return std::any_of(primitives().begin(), primitives().end(), has) || std::any_of(operators().begin(), operators().end(), has);
}

std::string childrenTaken(const ShapeType& type) {
    const std::string_view noun = type.min_children == 1 ? "child" : "children";
    return fmt::format("expected {}{} {}", type.min_children == type.max_children ? "" : "at least ", type.min_children, noun);
}

}  // namespace

void Reader::object(const Line& line, std::optional<Level> parent, bool bad_indent) {
    if (!room(line.indent, scene_.objects.size(), Limits::objects, "objects")) return;
    const int index = static_cast<int>(scene_.objects.size());
    Object o;
    o.id = scene_.newId();
    o.type = typeOf(line);
    if (parent && !bad_indent && !parent->unknown) parentTakes(line, *parent);
    if (parent && parent->object >= 0) o.parent = parent->object;
    readObject(line, o, parent && !bad_indent);
    if (!faults_.stopped()) nameOnce(line, "object", o.name, object_names_);

    scene_.objects.push_back(std::move(o));
    object_places_.push_back(faults_.place(line.indent));
    children_.push_back(0);
    levels_.back() = {index, scene_.objects.back().type == nullptr};
}

const ShapeType* Reader::typeOf(const Line& line) {
    const Piece* piece = findPiece(line, "type");
    if (!piece) {
        if (line.faults.empty()) faults_.add(line.indent, "no 'type', which an object must have");
        return nullptr;
    }
    const ShapeType* type = piece->value.quoted ? nullptr : findShapeType(piece->value.text);
    if (!type) faults_.add(piece->value.at, fmt::format("unknown type {}{}", shown(piece->value.text),
                                                        nearest(piece->value.text, typeNames())));
    return type;
}

/// Whether the record one level less indented may have this child.
void Reader::parentTakes(const Line& line, Level parent) {
    const ShapeType* type = parent.object >= 0 ? scene_.objects[static_cast<std::size_t>(parent.object)].type : nullptr;
    if (!type) {
        faults_.add(line.indent, "the record above it takes no children, expected an object that is an operator");
    } else if (!type->isOperator()) {
        faults_.add(line.indent, fmt::format("'{}' takes no children, expected an operator such as union", type->name));
    } else if (children_[static_cast<std::size_t>(parent.object)]++ == type->max_children) {
        faults_.add(line.indent, fmt::format("one child too many of '{}', {}", type->name, childrenTaken(*type)));
    }
}

void Reader::readObject(const Line& line, Object& o, bool child) {
    const std::string what = o.type ? fmt::format("a '{}'", o.type->name) : "an 'object'";
    std::vector<std::string_view> names(std::begin(kOwnKeys), std::end(kOwnKeys));
    if (o.type) {
        o.numbers = initialNumbers(*o.type);
        for (const Parameter& p : o.type->parameters) names.push_back(p.name);
    }
    const std::size_t faults_before = faults_.count();
    std::uint32_t seen = 0;
    const std::uint64_t rows = readKeys(faults_, what, line, 1, o, names,
                                        [&](const Piece& p) { return typeKey(p, o, seen); });
    if (faults_.stopped()) return;

    if (o.type && line.faults.empty())
        for (std::size_t i = 0; i < o.type->parameters.size(); ++i)
            if (const Parameter& p = o.type->parameters[i]; !p.optional && !(seen >> i & 1))
                faults_.add(line.indent, fmt::format("no '{}', which {} must have", p.name, what));
    if (child)
        for (std::size_t i = 0; i < keys<Object>().size(); ++i)
            if (const Key<Object>& key = keys<Object>()[i]; key.body && (rows >> i & 1))
                faults_.add(findPiece(line, key.name)->at,
                            fmt::format("'{}' is of a body, expected it only at the top level", key.name));
    const Piece* density = findPiece(line, "density");
    if (density && findPiece(line, "mass")) faults_.add(density->at, "both 'mass' and 'density', expected one of them");
    if (const Piece* normal = findPiece(line, "normal"); normal && faults_.count() == faults_before) {
        const double length = std::hypot(o.numbers[0], o.numbers[1], o.numbers[2]);
        if (!(length >= 1e-6)) faults_.add(normal->value.at, "'normal' has no length, expected a direction");
    }
}

/// A key that is not among the rows of all objects: `type`, `material`, or one of the type's own.
bool Reader::typeKey(const Piece& piece, Object& o, std::uint32_t& seen) {
    constexpr unsigned kType = 31, kMaterial = 30;
    const std::span<const Parameter> parameters = o.type ? o.type->parameters : std::span<const Parameter>{};
    unsigned bit = piece.key == "type" ? kType : piece.key == "material" ? kMaterial : 0;
    std::size_t first = 0;  // of the parameter's numbers
    if (bit == 0) {
        while (bit < parameters.size() && parameters[bit].name != piece.key) first += static_cast<std::size_t>(parameters[bit++].size);
        if (bit == parameters.size()) return !o.type && someTypesKey(piece.key);
    }
    if (seen >> bit & 1) {
        faults_.add(piece.at, fmt::format("'{}' stands twice in this record, expected once", piece.key));
        return true;
    }
    seen |= 1u << bit;
    ValueFault fault;
    if (bit == kMaterial) {
        Meant meant{scene_.objects.size(), faults_.place(piece.value.at), {}};
        fault = readText(piece.key, piece.value, meant.name);
        if (!fault) materials_meant_.push_back(std::move(meant));
    } else if (bit != kType) fault = readParameter(parameters[bit], piece.value, &o.numbers[first]);
    if (fault) faults_.add(piece.value.at + fault->at, fault->message);
    return true;
}

void Reader::finishObjects() {
    std::map<std::string_view, int> indices;
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) indices.emplace(scene_.materials[i].name, static_cast<int>(i));
    std::vector<std::string_view> names;
    for (const Meant& meant : materials_meant_) {
        if (faults_.stopped()) return;
        const auto found = indices.find(meant.name);
        if (found != indices.end()) {
            scene_.objects[meant.object].material = found->second;
            continue;
        }
        if (names.empty()) for (const Material& m : scene_.materials) names.push_back(m.name);
        faults_.add(meant.place, fmt::format("unknown material {}{}", shown(meant.name), nearest(meant.name, names)));
    }
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
        const ShapeType* type = scene_.objects[i].type;
        if (type && children_[i] < type->min_children)
            faults_.add(object_places_[i], fmt::format("'{}' has {} {}, {}", type->name, children_[i],
                                                       children_[i] == 1 ? "child" : "children", childrenTaken(*type)));
    }
}

namespace {
bool isInfinite(const Scene& scene, std::size_t object) {
    const Box box = bounds(makeTree(scene, [object](std::size_t i) { return i == object; }));
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (box.hi[axis] - box.lo[axis] == HUGE_VAL) return true;
    return false;
}
}  // namespace

void Reader::warn() {
    if (std::ranges::any_of(scene_.objects, [](const Object& o) { return o.type->isOperator() && asOperator(*o.type).kind != Operator::Kind::fold; }))
        if (const Tree tree = makeTree(scene_); !tree.fault.empty() && tree.fault_object < object_places_.size()) {
            const auto [line, column] = object_places_[tree.fault_object];
            warnings_.push_back({line, column, tree.fault + "; it cannot be drawn so"});
        }
    for (std::size_t i = 0; i < scene_.objects.size() && warnings_.size() < kMaxFaults; ++i) {
        const Object& o = scene_.objects[i];
        if (i >= object_places_.size()) return;
        const auto [line, column] = object_places_[i];
        if (!o.isBody() && (o.vel != glm::dvec3{0} || o.spin != glm::dvec3{0}))
            warnings_.push_back({line, column, fmt::format("{} has a vel or a spin, but no mass and no density, and does not move", shown(label(scene_, i)))});
        if (o.isBody() && o.type->name != "sphere" && isInfinite(scene_, i))
            warnings_.push_back({line, column, fmt::format("{} has a mass but is infinite, and does not move", shown(label(scene_, i)))});
    }
    if (warnings_.size() > kMaxFaults) warnings_.resize(kMaxFaults);
}

}  // namespace mb::text
