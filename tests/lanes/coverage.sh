run_lane() { skip coverage "not written yet"; }
