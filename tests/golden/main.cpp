// Prints a hash for every (operation, format, kernel); tests/data/golden.txt holds what it must print, everywhere.
#include "golden.hpp"

int main() {
    golden::print_texel();
    golden::print_filter();
    golden::print_receive();
    golden::print_grid();
    golden::print_facade();
    golden::print_lanes();
    golden::print_geometry();
}
