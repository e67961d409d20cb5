#if GNOMON_EXPECT_FAILURE
#error "gnomon: no expectation was written down"
#endif
