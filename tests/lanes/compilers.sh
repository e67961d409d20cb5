# What the fast lane leaves out: the test cases by g++ as users have it, and by clang all but them.
. "$root/tests/lanes/fast.sh"
run_lane() { preset_lanes cases strict; }
