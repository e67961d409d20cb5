// gnomon: soft shadow maps. A number that writes GLSL: the formulas of texel/ and receive/, evaluated with it, are shader text.
//
// So there is no second copy of the mathematics. `glsl::number` stands where a double does, `glsl::truth` where a bool does; what they
// hold is an expression. `let` makes a temporary of one, in the block of statements that the formula's inputs come from.
#pragma once

#include <gnomon/gl/glsl_text.hpp>
#include <gnomon/unit.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::inline GNOMON_BUILD {
namespace gl::glsl {

class block;

/// How tightly an expression holds together: what is weaker than its place asks for gets parentheses.
enum class binding { choice, both, comparison, sum, product, name };

/// A condition in GLSL. What is known when it is written is not written.
class truth {
  public:
    explicit truth(bool value) : text_(value ? "true" : "false"), value_(value) {}
    explicit truth(std::string text, binding holds = binding::name, block* where = nullptr)
        : text_(std::move(text)), holds_(holds), where_(where) {}
    explicit truth(const char* name) : truth(std::string(name)) {} // and not a pointer that is not null

    [[nodiscard]] const std::string& text() const noexcept { return text_; }
    [[nodiscard]] const std::optional<bool>& value() const noexcept { return value_; }
    [[nodiscard]] block* where() const noexcept { return where_; }
    [[nodiscard]] std::string within(binding place) const { return holds_ < place ? '(' + text_ + ')' : text_; }

    [[nodiscard]] friend truth operator!(const truth& t) {
        return t.value_ ? truth(!*t.value_) : truth('!' + t.within(binding::name), binding::product, t.where_);
    }
    [[nodiscard]] friend truth both(const truth& a, const truth& b) {
        if (a.value_) return *a.value_ ? b : a;
        if (b.value_) return both(b, a);
        return truth(a.within(binding::both) + " && " + b.within(binding::both), binding::both, any(a.where_, b.where_));
    }
    [[nodiscard]] friend truth select(const truth& condition, const truth& a, const truth& b) {
        return truth(condition.within(binding::both) + " ? " + a.within(binding::both) + " : " + b.within(binding::both),
                     binding::choice, any(condition.where_, any(a.where_, b.where_)));
    }

  private:
    [[nodiscard]] static block* any(block* a, block* b) noexcept { return a != nullptr ? a : b; }

    std::string text_;
    std::optional<bool> value_ = {};
    binding holds_ = binding::name;
    block* where_ = nullptr;
};

/// A float in GLSL. The few sums and products with a literal that change nothing are not written.
///
/// A comparison with a product is exact, as it is in doubles, and a quotient by a literal the nearest float: they are written as calls of
/// gnomon_exceeds and gnomon_divide, see shader_exact.hpp. All else is single precision, so a formula has to be exact in that, or say what
/// it loses.
///
/// A wide number is a vec2 whose components are to be added, see exceeds_blend_text. It stays wide where another is added or subtracted,
/// and is compared exactly with a product of one; all else makes a float of it.
class number {
  public:
    number() : number(0.0f) {}
    explicit number(float value) : text_(detail::literal(value)), value_(value) {}
    explicit number(double value) : number(static_cast<float>(value)) {}
    explicit number(int value) : number(static_cast<float>(value)) {}
    /// Something that has a name in the shader. What is made of it becomes temporaries of `where`, if that is told.
    explicit number(std::string name, block* where = nullptr) : text_(std::move(name)), where_(where) {}

    [[nodiscard]] static number wide(std::string name, block* where) {
        number made(std::move(name), where);
        made.wide_ = true;
        return made;
    }

    [[nodiscard]] const std::string& text() const noexcept { return text_; }
    [[nodiscard]] block* where() const noexcept { return where_; }
    [[nodiscard]] bool is_wide() const noexcept { return wide_; }
    /// A name or a literal: what needs no temporary.
    [[nodiscard]] bool is_short() const noexcept { return holds_ == binding::name; }

    [[nodiscard]] friend number operator-(const number& a) {
        return number('-' + a.within(binding::name), a, a, binding::product).as_wide_as(a);
    }
    [[nodiscard]] friend number operator+(const number& a, const number& b) {
        if (b.is(0.0f)) return a;
        const number more = b.beside(a);
        return number(a.within(binding::sum) + " + " + more.within(binding::sum), a, b, binding::sum).as_wide_as(a);
    }
    [[nodiscard]] friend number operator-(const number& a, const number& b) {
        if (b.value_ && *b.value_ <= 0.0f) return a + number(0.0f - *b.value_);
        const number less = b.beside(a);
        return number(a.within(binding::sum) + " - " + less.within(binding::product), a, b, binding::sum).as_wide_as(a);
    }
    [[nodiscard]] friend number operator*(const number& a, const number& b) {
        if (b.is(1.0f)) return a;
        number made(a.one().within(binding::product) + " * " + b.one().within(binding::name), a, b, binding::product);
        made.factors_ = {a.text_, b.text_, (-a).text_};
        return made;
    }
    [[nodiscard]] friend number operator/(const number& a, const number& b) {
        if (b.is(1.0f)) return a;
        if (b.value_)
            return number("gnomon_divide(" + a.one().text_ + ", " + b.text_ + ", " + detail::literal(1.0f / *b.value_) + ')', a, b,
                          binding::product);
        return number(a.one().within(binding::product) + " / " + b.one().within(binding::name), a, b, binding::product);
    }

    [[nodiscard]] friend truth operator>(const number& a, const number& b) {
        if (a.value_ && b.value_) return truth(*a.value_ > *b.value_);
        if (!a.factors_ && !b.factors_) return compared(a, " > ", b);
        const auto exceeds = [&](const std::string& left, const std::string& right, const std::string& sum) {
            return truth("gnomon_exceeds(" + left + ", " + right + ", " + sum + ')', binding::name, any(a.where_, b.where_));
        };
        return a.factors_ ? exceeds(a.factors_->left, a.factors_->right, b.text_)
                          : exceeds(b.factors_->minus_left, b.factors_->right, (-a).text_);
    }
    [[nodiscard]] friend truth operator<(const number& a, const number& b) {
        return a.factors_ || b.factors_ ? b > a : compared(a, " < ", b);
    }
    [[nodiscard]] friend number select(const truth& condition, const number& a, const number& b) {
        if (condition.value()) return *condition.value() ? a : b;
        return number(condition.within(binding::both) + " ? " + a.one().within(binding::sum) + " : " + b.one().within(binding::sum),
                      a, b, binding::choice);
    }

  private:
    struct product {
        std::string left, right, minus_left;
    };

    number(std::string text, const number& a, const number& b, binding holds)
        : text_(std::move(text)), where_(any(a.where_, b.where_)), holds_(holds) {}

    [[nodiscard]] number as_wide_as(const number& other) && {
        wide_ = other.wide_;
        return std::move(*this);
    }
    /// As a float.
    [[nodiscard]] number one() const {
        const std::string name = within(binding::name);
        return wide_ ? number(name + ".x + " + name + ".y", *this, *this, binding::sum) : *this;
    }
    /// As wide as `other`.
    [[nodiscard]] number beside(const number& other) const {
        if (wide_ == other.wide_) return *this;
        return wide_ ? one() : number("vec2(" + text_ + ", 0.0)", *this, *this, binding::name);
    }
    [[nodiscard]] bool is(float v) const noexcept { return value_ && same(*value_, v); }
    [[nodiscard]] std::string within(binding place) const { return holds_ < place ? '(' + text_ + ')' : text_; }
    [[nodiscard]] static truth compared(const number& a, const char* how, const number& b) {
        return truth(a.one().within(binding::sum) + how + b.one().within(binding::sum), binding::comparison,
                     any(a.where_, b.where_));
    }
    [[nodiscard]] static block* any(block* a, block* b) noexcept { return a != nullptr ? a : b; }

    std::string text_;
    std::optional<float> value_ = {};
    std::optional<product> factors_ = {};
    block* where_ = nullptr;
    binding holds_ = binding::name;
    bool wide_ = false;
};

/// The statements of a function, in order. Temporaries that nothing uses are left out.
class block {
  public:
    /// A temporary of this name, or of one like it if the name is taken.
    number let(const char* name, const number& value) {
        if (value.is_wide()) return number::wide(declare("precise vec2 ", name, value.text()), this);
        return number(declare("precise float ", name, value.text()), this);
    }
    truth let(const char* name, const truth& value) { return truth(declare("bool ", name, value.text()), binding::name, this); }
    /// Any other statement.
    void say(std::string statement) { lines_.push_back({"", std::move(statement)}); }

    [[nodiscard]] std::string text() const {
        std::string below;
        for (auto each = lines_.rbegin(); each != lines_.rend(); ++each)
            if (each->name.empty() || mentions(below, each->name)) below = "    " + each->statement + '\n' + below;
        return below;
    }

  private:
    struct line {
        std::string name;
        std::string statement;
    };
    std::string declare(const char* type, const std::string& name, const std::string& value) {
        std::string unique = name;
        for (int i = 2; declares(unique); ++i) unique = name + '_' + std::to_string(i);
        lines_.push_back({unique, type + unique + " = " + value + ";"});
        return unique;
    }
    [[nodiscard]] bool declares(const std::string& name) const {
        for (const line& each : lines_)
            if (each.name == name) return true;
        return false;
    }
    /// As a word of its own, and not as a member of something. A text begins with spaces.
    [[nodiscard]] static bool mentions(const std::string& text, const std::string& name) {
        constexpr std::string_view before = ".0123456789_abcdefghijklmnopqrstuvwxyz", after = before.substr(1);
        const auto none = [](std::string_view of, char c) { return of.find(c) == std::string_view::npos; };
        for (auto at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
            if (none(before, text[at - 1]) && none(after, text[at + name.size()])) return true;
        return false;
    }

    std::vector<line> lines_ = {};
};

/// What `let` is for other numbers too, see unit.hpp: here a temporary, unless the value is a name already.
[[nodiscard]] inline number let(const char* name, const number& value) {
    return value.where() == nullptr || value.is_short() ? value : value.where()->let(name, value);
}
[[nodiscard]] inline truth let(const char* name, const truth& value) {
    return value.where() == nullptr ? value : value.where()->let(name, value);
}

} // namespace gl::glsl
} // namespace gnomon::inline GNOMON_BUILD
