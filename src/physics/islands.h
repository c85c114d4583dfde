#pragma once
// Which bodies hang together through contacts: an island is solved by itself, and sleeps and wakes as one.
#include "physics/contact.h"

namespace mb {

class Islands {
public:
    Islands(std::size_t bodies, std::span<const Contact> contacts);

    /// The island a body is in: the least number of its bodies.
    int of(int body) const { return root_[static_cast<std::size_t>(body)]; }
    int of(const Contact& c) const { return of(c.a); }

    /// The contacts' numbers, those of one island together, in their own order; islands by number.
    std::vector<std::uint32_t> sorted(std::span<const Contact> contacts) const;

private:
    std::vector<int> root_;
};

}  // namespace mb
