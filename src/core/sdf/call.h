#pragma once
// Calls a member of Sdf<real> with its arguments read from a flat array of numbers.
#include "core/sdf/glsl.h"

#include <tuple>

namespace mb::sdf {

template <class R> R plain(double k) {
    if constexpr (std::is_same_v<R, float>) return static_cast<float>(k);
    else return R(k);
}
template <class T> struct Read {
    static constexpr int size = 1;
    static T from(const double*& k) { return plain<T>(*k++); }
};
template <class R> struct Read<Vec3<R>> {
    static constexpr int size = 3;
    static Vec3<R> from(const double*& k) {
        k += 3;
        return {plain<R>(k[-3]), plain<R>(k[-2]), plain<R>(k[-1])};
    }
};

template <class R, class... A> R call(R (Sdf<R>::*f)(Vec3<R>, A...), Vec3<R> p, const double* k) {
    const std::tuple<A...> arguments{Read<A>::from(k)...};  // braces fix the order of evaluation
    return std::apply([&](A... a) { return (Sdf<R>{}.*f)(p, a...); }, arguments);
}
template <class R, class... A> constexpr int argumentNumbers(R (Sdf<R>::*)(Vec3<R>, A...)) {
    return (0 + ... + Read<A>::size);
}

/// An operator on one distance, with or without the point; and a warp of the point.
template <class R, class... A> R wrap(R (Sdf<R>::*f)(R, Vec3<R>, A...), R d, Vec3<R> p, const double* k) {
    const std::tuple<A...> arguments{Read<A>::from(k)...};
    return std::apply([&](A... a) { return (Sdf<R>{}.*f)(d, p, a...); }, arguments);
}
template <class R, class... A> R wrap(R (Sdf<R>::*f)(R, A...), R d, Vec3<R>, const double* k) {
    const std::tuple<A...> arguments{Read<A>::from(k)...};
    return std::apply([&](A... a) { return (Sdf<R>{}.*f)(d, a...); }, arguments);
}
template <class R, class... A> Vec3<R> warp(Vec3<R> (Sdf<R>::*f)(Vec3<R>, A...), Vec3<R> p, const double* k) {
    const std::tuple<A...> arguments{Read<A>::from(k)...};
    return std::apply([&](A... a) { return (Sdf<R>{}.*f)(p, a...); }, arguments);
}
template <class R, class... A> constexpr int wrapNumbers(R (Sdf<R>::*)(R, A...)) { return (0 + ... + Read<A>::size); }
template <class R, class... A> constexpr int wrapNumbers(R (Sdf<R>::*)(R, Vec3<R>, A...)) { return (0 + ... + Read<A>::size); }
template <class R, class... A> constexpr bool takesPoint(R (Sdf<R>::*)(R, A...)) { return false; }
template <class R, class... A> constexpr bool takesPoint(R (Sdf<R>::*)(R, Vec3<R>, A...)) { return true; }

}  // namespace mb::sdf
