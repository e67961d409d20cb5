// expect: gnomon
#error "gnomon: fails either way"
