# The first part of the fast lane alone.
. "$root/tests/lanes/fast.sh"
run_lane() { preset_lanes quick; }
