#pragma once
// Scenes at random that a file can hold, with the values that are hardest to write: ends of ranges, the last bit, −0.
#include "core/scene/keys.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace mb::test {

inline unsigned long fromEnvironment(const char* name, unsigned long otherwise) {
    const char* text = std::getenv(name);
    return text ? std::strtoul(text, nullptr, 10) : otherwise;
}

class RandomScene {
public:
    explicit RandomScene(std::mt19937_64& random) : random_(random) {}

    Scene operator()() {
        Scene s;
        fill(s.world, ""), fill(s.render, ""), fill(s.physics, "");
        for (int n = below(3); n > 0; --n) {
            fill(s.cameras.emplace_back(), name("camera", n));
            s.cameras.back().target = s.cameras.back().eye + glm::dvec3{0, 0, s.cameras.back().eye.z > 0 ? -1 : 1};
        }
        for (int n = below(3); n > 0; --n) fill(s.lights.emplace_back(), name("light", n));
        for (int n = below(4); n > 0; --n) fill(s.materials.emplace_back(), name("material", n, false));
        for (int n = below(4); n > 0; --n) object(s, kNoParent, 0);
        return s;
    }

private:
    int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

    double real(double lo, double hi) {
        const double t = std::uniform_real_distribution<double>(0, 1)(random_);
        double x = lo + t * (hi - lo);
        switch (below(8)) {
        case 0: x = lo; break;
        case 1: x = hi; break;
        case 2: x = std::nextafter(lo, hi); break;
        case 3: x = std::nextafter(hi, lo); break;
        case 4: x = std::round(t * 100) / 10; break;
        case 5: x = below(2) != 0 ? 0.0 : -0.0; break;
        case 6: x = lo + std::exp2(-60 * t) * (hi - lo); break;
        default: break;
        }
        return std::clamp(x, lo, hi);
    }
    std::string name(std::string_view kind, int n, bool may_lack = true) {
        static constexpr std::string_view kOdd[] = {"", " ", "\"", "\\", "#", "a:b,c", "\\\"", "ß€😀", "\t", "7", "-", "\xe2\x80\x8f"};
        if (may_lack && below(3) == 0) return "";
        const std::string_view odd = kOdd[static_cast<std::size_t>(below(std::size(kOdd)))];
        return below(2) != 0 ? fmt::format("{}{}{}", kind, odd, n) : fmt::format("{}{}_{}", odd, kind, n);
    }
    template <class Record> void fill(Record& record, const std::string& name) {
        for (const Key<Record>& key : keys<Record>()) {
            if (!key.required && below(3) == 0) continue;
            std::visit([&](auto member) {
                set(valueAt(record, member), key.lo, key.hi, name);
                if constexpr (std::is_same_v<std::remove_cvref_t<decltype(valueAt(record, member))>, glm::dvec3>)
                    if (key.direction && valueAt(record, member) == glm::dvec3{0}) valueAt(record, member).y = 1;
                if constexpr (std::is_same_v<decltype(member), Slot>)
                    if (member.whole) valueAt(record, member) = std::floor(valueAt(record, member));
            }, key.member);
        }
    }
    // Not inlined: g++ 12 takes members of the one record for those of another.
    [[gnu::noinline]] void set(double& x, double lo, double hi, const std::string&) { x = real(lo, hi); }
    [[gnu::noinline]] void set(std::optional<double>& x, double lo, double hi, const std::string&) { x = real(lo, hi); }
    [[gnu::noinline]] void set(glm::dvec3& v, double lo, double hi, const std::string&) { v = {real(lo, hi), real(lo, hi), real(lo, hi)}; }
    [[gnu::noinline]] void set(int& x, double lo, double hi, const std::string&) { x = static_cast<int>(std::floor(real(lo, hi))); }
    [[gnu::noinline]] void set(bool& x, double, double, const std::string&) { x = below(2) != 0; }
    [[gnu::noinline]] void set(Pattern& x, double, double, const std::string&) { x = static_cast<Pattern>(below(2)); }
    [[gnu::noinline]] void set(std::string& x, double, double, const std::string& name) { x = name; }

    const ShapeType& type(int depth) {
        const int p = static_cast<int>(primitives().size()), o = static_cast<int>(operators().size());
        const int i = below(depth < 4 ? p + o : p);
        return i < p ? static_cast<const ShapeType&>(primitives()[static_cast<std::size_t>(i)])
                     : operators()[static_cast<std::size_t>(i - p)];
    }
    void object(Scene& s, int parent, int depth) {
        const int index = static_cast<int>(s.objects.size());
        Object o;
        fill(o, name("object", index));
        o.id = s.newId(), o.type = &type(depth), o.parent = parent, o.numbers = initialNumbers(*o.type);
        if (!s.materials.empty() && below(2) != 0) o.material = below(static_cast<int>(s.materials.size()));
        numbers(o);
        if (o.mass != 0 || std::signbit(o.mass)) o.density = 0;
        if (parent != kNoParent) o.mass = o.density = 0, o.vel = o.spin = {}, o.restitution = o.friction = o.rolling = o.spinning = {};
        s.objects.push_back(o);
        const int most = std::min(o.type->max_children, o.type->min_children + 2);
        for (int n = o.type->isOperator() ? o.type->min_children + below(most - o.type->min_children + 1) : 0; n > 0; --n)
            object(s, index, depth + 1);
    }
    void numbers(Object& o) {
        unsigned at = 0;
        for (const Parameter& p : o.type->parameters) {
            const bool said = below(4) != 0;
            for (int i = 0; i < p.size; ++i, ++at)
                if (said) o.numbers[at] = p.kind == Parameter::Kind::real ? real(p.lo, p.hi) : std::floor(real(p.lo, p.hi)) + 0.0;
            if (p.name == "normal" && std::hypot(o.numbers[0], o.numbers[1], o.numbers[2]) < 1e-3) o.numbers[1] = 1;
        }
    }

    std::mt19937_64& random_;
};

}  // namespace mb::test
