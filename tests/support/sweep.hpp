// A sweep over many cases makes one CHECK, and tells its first failure in words:
//     sweep wrong;
//     for (...) wrong.unless(holds, "E", E, "M", M);
//     CHECK(wrong.report() == "");
#pragma once

#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace test {

class sweep {
  public:
    template <typename... Words> void unless(bool holds, const Words&... words) {
        ++tried_;
        if (holds) return;
        if (wrong_++ == 0) first_ = sentence(words...);
#if defined(GNOMON_TEST_STOPS_AT_FIRST) // mutation asks whether one is wrong, and not how many
        throw std::runtime_error(report());
#endif
    }
    /// The same for cases by the billion: `cases(check)` calls check(holds, words...) for each. They are only counted; words are
    /// looked for in a second round, which begins if one is wrong.
    template <typename Cases> void unless_all(const Cases& cases) {
        std::size_t tried = 0, held = 0;
        cases([&](bool holds, const auto&...) {
            ++tried;
            held += holds ? 1 : 0;
        });
        if (held == tried)
            tried_ += tried;
        else
            cases([this](bool holds, const auto&... words) { this->unless(holds, words...); });
    }
    /// Another sweep's cases count as this one's.
    void add(const sweep& other) {
        if (wrong_ == 0) first_ = other.first_;
        tried_ += other.tried_;
        wrong_ += other.wrong_;
    }
    [[nodiscard]] std::size_t tried() const { return tried_; }
    /// Empty if every case held, and at least one was tried.
    [[nodiscard]] std::string report() const {
        if (tried_ == 0) return "no case was tried";
        return wrong_ == 0 ? "" : sentence(wrong_, "of", tried_, "are wrong, the first:", first_);
    }

  private:
    template <typename... Words> [[nodiscard]] static std::string sentence(const Words&... words) {
        std::ostringstream out;
        out.precision(std::numeric_limits<double>::max_digits10);
        const auto say = [&out](const auto& word) {
            using type = std::remove_cvref_t<decltype(word)>;
            if constexpr (std::is_integral_v<type> && sizeof(type) == 1)
                out << static_cast<int>(word) << ' '; // a number, not a letter
            else
                out << word << ' ';
        };
        (say(words), ...);
        return out.str();
    }

    std::size_t tried_ = 0;
    std::size_t wrong_ = 0;
    std::string first_;
};

} // namespace test
