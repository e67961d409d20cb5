// Half of a program whose two files include every header and use the same templates. The other half is two.cpp.
#include "use.hpp"

#include <cstdio>

float penumbra_of_two();

int main() {
    const ten_lines one = run_ten_lines();
    std::printf("lit %.3f umbra %.3f penumbra %.3f in front %.3f\n", static_cast<double>(one.lit), static_cast<double>(one.umbra),
                static_cast<double>(penumbra_of_two()), static_cast<double>(one.in_front));
}
