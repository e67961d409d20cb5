// gl_headless: the table of differences, as text that a page or a spreadsheet takes.
#pragma once

#include "compare.hpp"

namespace gl_headless {

/// A word for why anything differs at all: "edges, rounding". Empty if nothing does.
[[nodiscard]] std::string why(const comparison& c);

[[nodiscard]] std::string numbers_of(const std::vector<comparison>& table, std::size_t receivers); ///< in HTML
[[nodiscard]] std::string csv_head();
[[nodiscard]] std::string csv_of(const std::string& id, const std::vector<comparison>& table);
/// What the columns mean, in HTML. `renderer` is what GL calls itself.
[[nodiscard]] std::string about(const std::string& renderer, const std::string& mesh_name);

} // namespace gl_headless
