// Reads of a line through libc's streams (FILE). libc reads in internal functions that cannot be replaced, so
// these functions wait before libc would: whenever the stream's buffer is empty. Streams of other files go to
// libc at once.
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

namespace {

// Flags of libc's FILE, as <bits/types/struct_FILE.h> names only some. Programs have them compiled in, so no
// release may change them.
constexpr int kUnbuffered = 0x0002;
constexpr int kNoReads = 0x0004;
constexpr int kInBackup = 0x0100;
constexpr int kCurrentlyPutting = 0x0800;
constexpr size_t kDefaultBuffer = 1024;  // of a terminal

size_t in_buffer(const FILE* file) {
  const ptrdiff_t now = file->_IO_read_end - file->_IO_read_ptr;
  const bool is_in_backup = (file->_flags & kInBackup) != 0;  // in characters that were put back
  const ptrdiff_t later = is_in_backup ? file->_IO_save_end - file->_IO_save_base : 0;
  return static_cast<size_t>((now > 0 ? now : 0) + (later > 0 ? later : 0));
}

bool is_wide(const FILE* file) { return file->_mode > 0; }

/// Returns true if reads of this stream wait for the bench once its buffer is empty.
bool is_of_bench(const FILE* file) {
  if (!is_active() || is_wide(file) || (file->_flags & kNoReads) != 0 || file->_fileno < 0) return false;
  int number = -1;
  return is_line(file->_fileno, &number) || is_door(file->_fileno, &number);
}

/// Call this before libc reads a character. Returns false, with the stream's error or end noted, if it must
/// not, because it would wait for a byte that does not come.
bool is_filled(FILE* file) {
  if (in_buffer(file) > 0) return true;
  if ((file->_flags & _IO_EOF_SEEN) != 0) return false;                // until the program clears it
  if ((file->_flags & kCurrentlyPutting) != 0) fflush_unlocked(file);  // libc does so too, but after our wait
  size_t size = kDefaultBuffer;
  if ((file->_flags & kUnbuffered) != 0) {
    size = 1;
  } else if (file->_IO_buf_end > file->_IO_buf_base) {
    size = static_cast<size_t>(file->_IO_buf_end - file->_IO_buf_base);
  }
  const ssize_t max = wait_to_read(file->_fileno, size);
  if (max > 0) return true;
  file->_flags |= max == 0 ? _IO_EOF_SEEN : _IO_ERR_SEEN;
  return false;
}

/// Reads a character of a stream of the bench, which is locked.
int next_character(FILE* file) { return is_filled(file) ? UNDERSTUDY_REAL(getc_unlocked)(file) : EOF; }

/// Locks a stream while it exists.
class Locked {
 public:
  explicit Locked(FILE* file) : file_(file) { flockfile(file); }
  ~Locked() { funlockfile(file_); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  FILE* file_;
};

/// Returns true if libc finds in the buffer all that it needs: so many characters, or one of this value.
bool has_enough(const FILE* file, size_t size, int end) {
  if (!is_active() || is_wide(file)) return true;
  const ptrdiff_t count = file->_IO_read_end - file->_IO_read_ptr;
  if (count <= 0) return false;
  const auto present = static_cast<size_t>(count);
  return present >= size || (end >= 0 && memchr(file->_IO_read_ptr, end, present) != nullptr);
}

int read_character(FILE* file) {
  const Locked locked(file);
  return next_character(file);
}

char* read_line(FILE* file, char* place, size_t size) {
  size_t done = 0;
  const int flags = file->_flags;
  file->_flags &= ~_IO_ERR_SEEN;  // an earlier error is no error of this read
  while (done + 1 < size) {
    const int c = next_character(file);
    if (c == EOF) break;
    place[done++] = static_cast<char>(c);
    if (c == '\n') break;
  }
  const bool has_failed = (file->_flags & _IO_ERR_SEEN) != 0 && errno != EAGAIN;
  file->_flags |= flags & _IO_ERR_SEEN;
  if (done == 0 || has_failed) return nullptr;
  place[done] = '\0';
  return place;
}

/// As getdelim() does.
ssize_t read_until(FILE* file, char** place, size_t* room, int end) {
  if (place == nullptr || room == nullptr) {
    errno = EINVAL;
    return -1;
  }
  if (*place == nullptr) *room = 0;
  size_t done = 0;
  for (int c = 0; c != end;) {
    c = next_character(file);
    if (c == EOF) break;
    if (done + 2 > *room) {
      constexpr size_t kLeast = 120;
      const size_t more = *room * 2 > kLeast ? *room * 2 : kLeast;
      auto* const larger = static_cast<char*>(realloc(*place, more));
      if (larger == nullptr) return -1;
      *place = larger;
      *room = more;
    }
    (*place)[done++] = static_cast<char>(c);
  }
  if (done == 0) return -1;
  (*place)[done] = '\0';
  return static_cast<ssize_t>(done);
}

size_t read_items(FILE* file, void* place, size_t size, size_t count) {
  size_t done = 0;
  while (done < size * count) {
    const int c = next_character(file);
    if (c == EOF) break;
    static_cast<unsigned char*>(place)[done++] = static_cast<unsigned char>(c);
  }
  return done / size;
}

// --- scanf -----------------------------------------------------------------------------------------

ssize_t pass_on(void* cookie, char* place, size_t size) {
  auto* const file = static_cast<FILE*>(cookie);
  const int c = size == 0 ? EOF : next_character(file);
  if (c == EOF) return (file->_flags & _IO_ERR_SEEN) != 0 ? -1 : 0;
  *place = static_cast<char>(c);
  return 1;
}

/// Lets libc scan a stream whose characters come from ours one by one, each after its wait.
template <class Scan>
int scan_through(FILE* file, Scan scan) {
  const Locked locked(file);
  cookie_io_functions_t functions = {};
  functions.read = pass_on;
  FILE* const between = fopencookie(file, "r", functions);
  if (between == nullptr) return EOF;
  setvbuf(between, nullptr, _IONBF, 0);
  const int result = scan(between);
  const int error = errno;
  // The character that has ended a number belongs to the next read.
  if (between->_IO_read_end > between->_IO_read_ptr)
    ungetc(static_cast<unsigned char>(*between->_IO_read_ptr), file);
  fclose(between);
  errno = error;
  return result;
}

using VScan = int (*)(FILE*, const char*, va_list);

int scan(VScan real, FILE* file, const char* format, va_list list) {
  if (!is_of_bench(file)) return real(file, format, list);
  return scan_through(file, [&](FILE* between) { return real(between, format, list); });
}

VScan real_scan(const char* name) { return reinterpret_cast<VScan>(dlsym(RTLD_NEXT, name)); }

}  // namespace

// --- characters ------------------------------------------------------------------------------------

UNDERSTUDY_EXPORT int fgetc(FILE* file) {
  if (has_enough(file, 1, -1) || !is_of_bench(file)) return UNDERSTUDY_REAL(fgetc)(file);
  return read_character(file);
}

#undef getc
UNDERSTUDY_EXPORT int getc(FILE* file) { return fgetc(file); }
UNDERSTUDY_EXPORT int _IO_getc(FILE* file) { return fgetc(file); }

#undef getchar
UNDERSTUDY_EXPORT int getchar() { return fgetc(stdin); }

#undef getc_unlocked
UNDERSTUDY_EXPORT int getc_unlocked(FILE* file) {
  if (has_enough(file, 1, -1) || !is_of_bench(file)) return UNDERSTUDY_REAL(getc_unlocked)(file);
  return next_character(file);
}

#undef fgetc_unlocked
UNDERSTUDY_EXPORT int fgetc_unlocked(FILE* file) { return getc_unlocked(file); }

#undef getchar_unlocked
UNDERSTUDY_EXPORT int getchar_unlocked() { return getc_unlocked(stdin); }

/// Programs have getc_unlocked compiled in, and call this when the buffer is empty.
UNDERSTUDY_EXPORT int __uflow(FILE* file) {
  if (is_of_bench(file) && !is_filled(file)) return EOF;
  return UNDERSTUDY_REAL(__uflow)(file);
}

// --- lines -----------------------------------------------------------------------------------------

UNDERSTUDY_EXPORT char* fgets_unlocked(char* place, int size, FILE* file) {
  const bool is_real =
      size <= 1 || has_enough(file, static_cast<size_t>(size) - 1, '\n') || !is_of_bench(file);
  return is_real ? UNDERSTUDY_REAL(fgets_unlocked)(place, size, file)
                 : read_line(file, place, static_cast<size_t>(size));
}

UNDERSTUDY_EXPORT char* fgets(char* place, int size, FILE* file) {
  if (size <= 1 || has_enough(file, static_cast<size_t>(size) - 1, '\n') || !is_of_bench(file))
    return UNDERSTUDY_REAL(fgets)(place, size, file);
  const Locked locked(file);
  return read_line(file, place, static_cast<size_t>(size));
}

UNDERSTUDY_EXPORT char* __fgets_chk(char* place, size_t room, int size, FILE* file) {
  if (size > 0 && static_cast<size_t>(size) > room) abort();
  return fgets(place, size, file);
}

UNDERSTUDY_EXPORT char* __fgets_unlocked_chk(char* place, size_t room, int size, FILE* file) {
  if (size > 0 && static_cast<size_t>(size) > room) abort();
  return fgets_unlocked(place, size, file);
}

#undef getdelim
UNDERSTUDY_EXPORT ssize_t getdelim(char** place, size_t* room, int end, FILE* file) {
  if (has_enough(file, SIZE_MAX, end) || !is_of_bench(file))
    return UNDERSTUDY_REAL(getdelim)(place, room, end, file);
  const Locked locked(file);
  return read_until(file, place, room, end);
}

UNDERSTUDY_EXPORT ssize_t __getdelim(char** place, size_t* room, int end, FILE* file) {
  return getdelim(place, room, end, file);
}

#undef getline
UNDERSTUDY_EXPORT ssize_t getline(char** place, size_t* room, FILE* file) {
  return getdelim(place, room, '\n', file);
}

// --- blocks ----------------------------------------------------------------------------------------

#undef fread_unlocked
UNDERSTUDY_EXPORT size_t fread_unlocked(void* place, size_t size, size_t count, FILE* file) {
  size_t all = 0;
  const bool is_real = size == 0 || __builtin_mul_overflow(size, count, &all) || has_enough(file, all, -1) ||
                       !is_of_bench(file);
  return is_real ? UNDERSTUDY_REAL(fread_unlocked)(place, size, count, file)
                 : read_items(file, place, size, count);
}

UNDERSTUDY_EXPORT size_t fread(void* place, size_t size, size_t count, FILE* file) {
  size_t all = 0;
  if (size == 0 || __builtin_mul_overflow(size, count, &all) || has_enough(file, all, -1) ||
      !is_of_bench(file))
    return UNDERSTUDY_REAL(fread)(place, size, count, file);
  const Locked locked(file);
  return read_items(file, place, size, count);
}

UNDERSTUDY_EXPORT size_t __fread_chk(void* place, size_t room, size_t size, size_t count, FILE* file) {
  size_t all = 0;
  if (__builtin_mul_overflow(size, count, &all) || all > room) abort();
  return fread(place, size, count, file);
}

UNDERSTUDY_EXPORT size_t __fread_unlocked_chk(void* place, size_t room, size_t size, size_t count,
                                              FILE* file) {
  size_t all = 0;
  if (__builtin_mul_overflow(size, count, &all) || all > room) abort();
  return fread_unlocked(place, size, count, file);
}

// --- scanf: the names that C and its later standards have for it --------------------------------------

// Headers redirect the plain names to those of C99, so these are defined under the names of their symbols.
#define UNDERSTUDY_SCANS(prefix)                                                                     \
  UNDERSTUDY_EXPORT int understudy##prefix##vfscanf(FILE* file, const char* format,                  \
                                                    va_list list) __asm__(#prefix "vfscanf");        \
  int understudy##prefix##vfscanf(FILE* file, const char* format, va_list list) {                    \
    static VScan real = nullptr;                                                                     \
    if (real == nullptr) real = real_scan(#prefix "vfscanf");                                        \
    return scan(real, file, format, list);                                                           \
  }                                                                                                  \
  UNDERSTUDY_EXPORT int understudy##prefix##vscanf(const char* format,                               \
                                                   va_list list) __asm__(#prefix "vscanf");          \
  int understudy##prefix##vscanf(const char* format, va_list list) {                                 \
    return understudy##prefix##vfscanf(stdin, format, list);                                         \
  }                                                                                                  \
  UNDERSTUDY_EXPORT int understudy##prefix##fscanf(FILE* file, const char* format,                   \
                                                   ...) __asm__(#prefix "fscanf");                   \
  int understudy##prefix##fscanf(FILE* file, const char* format, ...) {                              \
    va_list list;                                                                                    \
    va_start(list, format);                                                                          \
    const int result = understudy##prefix##vfscanf(file, format, list);                              \
    va_end(list);                                                                                    \
    return result;                                                                                   \
  }                                                                                                  \
  UNDERSTUDY_EXPORT int understudy##prefix##scanf(const char* format, ...) __asm__(#prefix "scanf"); \
  int understudy##prefix##scanf(const char* format, ...) {                                           \
    va_list list;                                                                                    \
    va_start(list, format);                                                                          \
    const int result = understudy##prefix##vfscanf(stdin, format, list);                             \
    va_end(list);                                                                                    \
    return result;                                                                                   \
  }
UNDERSTUDY_SCANS()
UNDERSTUDY_SCANS(__isoc99_)
UNDERSTUDY_SCANS(__isoc23_)
