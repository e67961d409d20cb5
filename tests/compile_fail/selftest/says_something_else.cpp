// expect: gnomon: one reason
#if GNOMON_EXPECT_FAILURE
#error "gnomon: another reason"
#endif
