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

}  // namespace mb::sdf
