#include <gnomon/receive/decide.hpp> // which is printed in them

#include "golden_texts.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

// GNOMON_WRITE_GOLDEN=1 in the environment writes the files anew, for a reader to compare.
TEST_CASE("shader texts are those in tests/gl/golden") {
    const char* write = std::getenv("GNOMON_WRITE_GOLDEN");
    for (const auto& [name, text] : test::golden_texts()) {
        const std::string path = GNOMON_TEST_DATA "/../gl/golden/" + name + ".glsl";
        if (write != nullptr) std::ofstream(path) << text;
        std::ifstream file(path);
        std::ostringstream kept;
        kept << file.rdbuf();
        INFO(path);
        CHECK(kept.str() == text);
    }
}
