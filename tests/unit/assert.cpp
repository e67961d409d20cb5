// GNOMON_ASSERT may be routed elsewhere before the first include; what it guards has a written result all the same.
namespace {
int failed = 0;
const char* sentence_of_the_failed = "";
} // namespace
#define GNOMON_ASSERT(condition, sentence) ((condition) ? void() : (++failed, sentence_of_the_failed = (sentence), void()))
#include <gnomon/texel/image.hpp>

#include <doctest/doctest.h>

#include <string>

namespace {
struct element { // of this file alone, so that no other file shares the views it makes
    int number;
};
} // namespace

TEST_CASE("a wrong call reaches the assertion that the host has chosen and a right one does not") {
    failed = 0;
    element memory[6]{};
    const gnomon::image_view<element> right(memory, {3, 2}), empty(nullptr, {0, 2});
    CHECK(failed == 0);
    const gnomon::image_view<element> wrong(nullptr, {3, 2});
    CHECK(failed == 1);
    CHECK(std::string(sentence_of_the_failed) == "gnomon: an image_view that is not empty needs memory");
    CHECK(right.size() == gnomon::extent{3, 2});
    CHECK(empty.size().empty());
    CHECK(wrong.size().empty());
    const gnomon::image_view<element> askew(memory, {3, 2}, 13);
    CHECK(failed == 2);
    CHECK(std::string(sentence_of_the_failed) == "gnomon: the rows of an image_view must be aligned for its texels");
    CHECK(askew.stride() == 13);
}
