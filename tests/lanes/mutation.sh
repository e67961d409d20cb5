run_lane() { skip mutation "not written yet"; }
