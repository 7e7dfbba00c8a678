// What is here: what the leak sanitizer is told about the font library, which keeps caches that it never frees.
// What is not: anything for leaks of our own.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig.so\n";
}
