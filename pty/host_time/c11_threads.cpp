// C11's functions for threads. libc builds them on internal functions that cannot be replaced, so they are
// built here on ours (threads.cpp). libc's types are the same under both names.
#include <errno.h>
#include <pthread.h>
#include <threads.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

static_assert(sizeof(cnd_t) == sizeof(pthread_cond_t) && sizeof(mtx_t) == sizeof(pthread_mutex_t));

namespace {

pthread_cond_t* same(cnd_t* condition) { return reinterpret_cast<pthread_cond_t*>(condition); }
pthread_mutex_t* same(mtx_t* mutex) { return reinterpret_cast<pthread_mutex_t*>(mutex); }

int result_of(int error) {
  switch (error) {
    case 0: return thrd_success;
    case ETIMEDOUT: return thrd_timedout;
    case EBUSY: return thrd_busy;
    case ENOMEM: return thrd_nomem;
    default: return thrd_error;
  }
}

}  // namespace

UNDERSTUDY_EXPORT int cnd_init(cnd_t* condition) {
  return result_of(pthread_cond_init(same(condition), nullptr));
}

UNDERSTUDY_EXPORT void cnd_destroy(cnd_t* condition) { pthread_cond_destroy(same(condition)); }

UNDERSTUDY_EXPORT int cnd_signal(cnd_t* condition) { return result_of(pthread_cond_signal(same(condition))); }

UNDERSTUDY_EXPORT int cnd_broadcast(cnd_t* condition) {
  return result_of(pthread_cond_broadcast(same(condition)));
}

UNDERSTUDY_EXPORT int cnd_wait(cnd_t* condition, mtx_t* mutex) {
  return result_of(pthread_cond_wait(same(condition), same(mutex)));
}

UNDERSTUDY_EXPORT int cnd_timedwait(cnd_t* condition, mtx_t* mutex, const timespec* time) {
  return result_of(pthread_cond_timedwait(same(condition), same(mutex), time));
}

UNDERSTUDY_EXPORT int mtx_timedlock(mtx_t* mutex, const timespec* time) {
  return result_of(pthread_mutex_timedlock(same(mutex), time));
}
