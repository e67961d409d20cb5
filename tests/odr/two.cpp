#include "use.hpp"

float penumbra_of_two();
float penumbra_of_two() { return run_ten_lines().penumbra; }
