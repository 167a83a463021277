// Preloaded into a program, refuses its memory: the VORPIPE_REFUSE_MEMORY-th allocation on any thread since
// main began, or with VORPIPE_REFUSE_ALL=1 that one and all that follow. How many there were goes to the file
// VORPIPE_COUNT_MEMORY. What is before main belongs to the loader of programs. A program may choose others by
// vorpipe_refuse_memory.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

std::atomic<bool> has_begun{false};
std::atomic<long> allocations{0};
long refused = 0;
bool all_after = false;

bool isRefused() {
  if (!has_begun) return false;
  const long nth = ++allocations;
  const bool refuses = refused > 0 && (nth == refused || (all_after && nth > refused));
  if (refuses) errno = ENOMEM;
  return refuses;
}

long numberOf(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? 0 : std::atol(text);
}

void writeCount() {
  const char* const path = std::getenv("VORPIPE_COUNT_MEMORY");
  if (path == nullptr) return;
  char digits[24];
  char* begin = digits + sizeof digits;
  for (long left = allocations; begin == digits + sizeof digits || left > 0; left /= 10) {
    *--begin = static_cast<char>('0' + left % 10);
  }
  const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0 || write(file, begin, static_cast<std::size_t>(digits + sizeof digits - begin)) < 0)
    std::abort();
  close(file);
}

using Main = int (*)(int, char**, char**);
Main program = nullptr;

int countedMain(int count, char** arguments, char** environment) {
  refused = numberOf("VORPIPE_REFUSE_MEMORY");
  all_after = numberOf("VORPIPE_REFUSE_ALL") != 0;
  has_begun = true;
  const int code = program(count, arguments, environment);
  has_begun = false;
  writeCount();
  return code;
}

}  // namespace

extern "C" {

/// The nth allocation from now on is refused, and with `all` all that follow; 0: none is.
void vorpipe_refuse_memory(long nth, int all) {
  refused = nth;
  all_after = all != 0;
  allocations = 0;
}

void* malloc(std::size_t size) { return isRefused() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) {
  return isRefused() ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) { return isRefused() ? nullptr : __libc_realloc(memory, size); }
void* memalign(std::size_t alignment, std::size_t size) {
  return isRefused() ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  void* const found = memalign(alignment, size);
  if (found != nullptr) *memory = found;
  return found == nullptr ? ENOMEM : 0;
}

int __libc_start_main(Main main_function, int count, char** arguments, void (*init)(), void (*fini)(),
                      void (*loader_fini)(), void* stack_end) {
  program = main_function;
  void* const next = dlsym(RTLD_NEXT, "__libc_start_main");
  decltype(&__libc_start_main) start = nullptr;
  std::memcpy(&start, &next, sizeof start);
  return start(countedMain, count, arguments, init, fini, loader_fini, stack_end);
}
}
