// expect: gnomon
int fine = 1;
