// C++ again.
#undef float
#undef bool
#undef precise
#undef layout
#undef uniform
#undef in
#undef out
#undef flat
#ifdef __clang__
#pragma clang diagnostic pop
#else
#pragma GCC diagnostic pop
#endif
