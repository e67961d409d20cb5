// gnomon: soft shadow maps. What went wrong in the world, as a sentence; and a value that may be missing for such a reason.
#pragma once

#include <gnomon/config.hpp>

#include <optional>
#include <string>
#include <utility>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// Why something cannot be had of this GL: a sentence for a log. Empty means that nothing is wrong, and tests false.
struct [[nodiscard]] problem {
    std::string sentence = {};

    [[nodiscard]] explicit operator bool() const noexcept { return !sentence.empty(); }
};

/// A T, or the problem that left none: `if (!made) log(made.error().sentence);  use(*made);`
template <typename T> class [[nodiscard]] result {
  public:
    result(T value) : value_(std::move(value)) {}
    result(problem why) : why_(std::move(why)) {
        GNOMON_ASSERT(static_cast<bool>(why_), "gnomon: a result without a value needs a sentence that says why");
    }

    [[nodiscard]] explicit operator bool() const noexcept { return value_.has_value(); }
    /// \pre there is a value
    [[nodiscard]] T& operator*() & noexcept { return *value_; }
    [[nodiscard]] const T& operator*() const& noexcept { return *value_; }
    [[nodiscard]] T&& operator*() && noexcept { return *std::move(value_); }
    [[nodiscard]] T* operator->() noexcept { return &*value_; }
    [[nodiscard]] const T* operator->() const noexcept { return &*value_; }
    /// Empty where there is a value.
    [[nodiscard]] const problem& error() const noexcept { return why_; }

  private:
    std::optional<T> value_ = {};
    problem why_ = {};
};

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
