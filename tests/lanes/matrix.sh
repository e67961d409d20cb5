run_lane() { skip matrix "not written yet"; }
