// Counts allocations. Replaces operator new for the whole program: for one file of it.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace test {
inline long allocations = 0;

inline void* counted(std::size_t bytes, std::size_t alignment) {
    ++allocations;
    if (void* p = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment)) return p;
    throw std::bad_alloc();
}
/// Out of line: g++ takes a free for a mistake where it sees that and not the new.
[[gnu::noinline]] inline void released(void* p) noexcept { std::free(p); }
} // namespace test

void* operator new(std::size_t bytes) { return test::counted(bytes, alignof(std::max_align_t)); }
void* operator new[](std::size_t bytes) { return test::counted(bytes, alignof(std::max_align_t)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return test::counted(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
    return test::counted(bytes, static_cast<std::size_t>(alignment));
}
// Not declared by clang, which does not call them.
void operator delete(void*, std::size_t) noexcept;
void operator delete[](void*, std::size_t) noexcept;
void operator delete(void*, std::size_t, std::align_val_t) noexcept;
void operator delete[](void*, std::size_t, std::align_val_t) noexcept;

void operator delete(void* p) noexcept { test::released(p); }
void operator delete[](void* p) noexcept { test::released(p); }
void operator delete(void* p, std::size_t) noexcept { test::released(p); }
void operator delete[](void* p, std::size_t) noexcept { test::released(p); }
void operator delete(void* p, std::align_val_t) noexcept { test::released(p); }
void operator delete[](void* p, std::align_val_t) noexcept { test::released(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { test::released(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { test::released(p); }

namespace test {
/// Allocations made while f runs.
template <typename F> long allocations_in(F&& f) {
    const long before = allocations;
    f();
    return allocations - before;
}
} // namespace test
