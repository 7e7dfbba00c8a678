// What is here: a library for LD_PRELOAD that counts the calls of a program (and of the programs it starts) which a
// full disk or a lack of memory can fail, and fails one of them. What is not: which call is tried when (try_faults.py).
//
// FAULT_COUNT  a file of 8 bytes that all processes of one try map and count in
// FAULT_AT     number of the call that fails, from 1; 0: none
// FAULT_STAYS  1: all calls from there on fail as well, as on a disk that stays full
// FAULT_KIND   "disk": write, pwrite, fsync, fdatasync, rename, link, ftruncate, mkdir and open for writing;
//              "memory": malloc, calloc, realloc, aligned_alloc, posix_memalign and mmap of FAULT_BYTES and more
// FAULT_ERROR  the number of the error, ENOSPC without it
// FAULT_LOG    a file that each failed call is named in
//
// It misses what the C library does inside itself (stdio); the program writes nothing that way but standard output.
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static unsigned long* counter;
static unsigned long own_counter, fail_at, least_bytes = 1UL << 20;
static int stays, disk, memory, error_number = ENOSPC, ready;

static void log_call(const char* call, const char* what) {
  const char* file = getenv("FAULT_LOG");
  if (!file) return;
  const long log = syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND, 0644);
  char line[512];
  const int length = snprintf(line, sizeof line, "%s %s\n", call, what ? what : "");
  syscall(SYS_write, log, line, length < (int)sizeof line ? length : (int)sizeof line - 1);
  syscall(SYS_close, log);
}

__attribute__((constructor)) static void start(void) {
  const char* kind = getenv("FAULT_KIND");
  const char* file = getenv("FAULT_COUNT");
  const char* at = getenv("FAULT_AT");
  const char* keep = getenv("FAULT_STAYS");
  const char* number = getenv("FAULT_ERROR");
  const char* bytes = getenv("FAULT_BYTES");
  counter = &own_counter;
  if (file) {
    const long count = syscall(SYS_openat, AT_FDCWD, file, O_RDWR, 0);
    void* place = (void*)syscall(SYS_mmap, 0, sizeof *counter, PROT_READ | PROT_WRITE, MAP_SHARED, count, 0);
    syscall(SYS_close, count);
    if (place != MAP_FAILED) counter = place;
  }
  fail_at = at ? strtoul(at, NULL, 10) : 0;
  stays = keep && *keep == '1';
  if (bytes) least_bytes = strtoul(bytes, NULL, 10);
  memory = kind && strcmp(kind, "memory") == 0;
  disk = !memory;
  error_number = number ? atoi(number) : memory ? ENOMEM : ENOSPC;
  ready = 1;
}

static int fails(const char* call, const char* what) {
  const unsigned long number = __atomic_add_fetch(counter, 1, __ATOMIC_SEQ_CST);
  if (fail_at == 0 || number < fail_at || (number > fail_at && !stays)) return 0;
  log_call(call, what);
  errno = error_number;
  return 1;
}

// Only files: what goes to a terminal, a pipe or a socket is no matter of the disk.
static int is_file(int descriptor) {
  struct stat status;
  return fstat(descriptor, &status) == 0 && (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode));
}

ssize_t write(int d, const void* data, size_t n) {
  if (ready && disk && is_file(d) && fails("write", NULL)) {
    if (n > 1) syscall(SYS_write, d, data, n / 2);  // a full disk takes a part
    errno = error_number;
    return -1;
  }
  return syscall(SYS_write, d, data, n);
}
ssize_t pwrite(int d, const void* data, size_t n, off_t at) {
  if (ready && disk && is_file(d) && fails("pwrite", NULL)) return -1;
  return syscall(SYS_pwrite64, d, data, n, at);
}
ssize_t pwrite64(int d, const void* data, size_t n, off_t at) {
  return pwrite(d, data, n, at);
}
int fsync(int d) {
  if (ready && disk && fails("fsync", NULL)) return -1;
  return (int)syscall(SYS_fsync, d);
}
int fdatasync(int d) {
  if (ready && disk && fails("fdatasync", NULL)) return -1;
  return (int)syscall(SYS_fdatasync, d);
}
int rename(const char* a, const char* b) {
  if (ready && disk && fails("rename", b)) return -1;
  return (int)syscall(SYS_renameat, AT_FDCWD, a, AT_FDCWD, b);
}
int link(const char* a, const char* b) {
  if (ready && disk && fails("link", b)) return -1;
  return (int)syscall(SYS_linkat, AT_FDCWD, a, AT_FDCWD, b, 0);
}
int ftruncate(int d, off_t n) {
  if (ready && disk && is_file(d) && fails("ftruncate", NULL)) return -1;
  return (int)syscall(SYS_ftruncate, d, n);
}
int ftruncate64(int d, off_t n) {
  return ftruncate(d, n);
}
int mkdir(const char* path, mode_t mode) {
  struct stat status;  // one that is there already needs no room
  if (ready && disk && stat(path, &status) != 0 && fails("mkdir", path)) return -1;
  return (int)syscall(SYS_mkdirat, AT_FDCWD, path, mode);
}
static int open_file(int folder, const char* path, int flags, mode_t mode) {
  if (ready && disk && (flags & O_CREAT) && strncmp(path, "/dev/", 5) != 0 && fails("open", path)) return -1;
  return (int)syscall(SYS_openat, folder, path, flags, mode);
}
#define OPEN(name)                                 \
  int name(const char* path, int flags, ...) {     \
    va_list rest;                                  \
    va_start(rest, flags);                         \
    const mode_t mode = va_arg(rest, mode_t);      \
    va_end(rest);                                  \
    return open_file(AT_FDCWD, path, flags, mode); \
  }
OPEN(open)
OPEN(open64)
int openat(int folder, const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  return open_file(folder, path, flags, mode);
}

#define NO_MEMORY(n) (ready && memory && (n) >= least_bytes && fails("memory", NULL))
extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);
void* malloc(size_t n) {
  return NO_MEMORY(n) ? NULL : __libc_malloc(n);
}
void* calloc(size_t k, size_t n) {
  return NO_MEMORY(k * n) ? NULL : __libc_calloc(k, n);
}
void* realloc(void* p, size_t n) {
  return NO_MEMORY(n) ? NULL : __libc_realloc(p, n);
}
void* aligned_alloc(size_t a, size_t n) {
  return NO_MEMORY(n) ? NULL : __libc_memalign(a, n);
}
int posix_memalign(void** p, size_t a, size_t n) {
  if (NO_MEMORY(n)) return ENOMEM;
  *p = __libc_memalign(a, n);
  return *p ? 0 : ENOMEM;
}
void* mmap(void* at, size_t n, int protection, int flags, int d, off_t offset) {
  if ((flags & MAP_ANONYMOUS) && !(flags & MAP_STACK) && NO_MEMORY(n)) return MAP_FAILED;
  return (void*)syscall(SYS_mmap, at, n, protection, flags, d, offset);
}
