// A host with three threads: one polls, one waits for the results, one prints the time.
#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

std::mutex mutex;
std::condition_variable changed;
int polled = 0;
bool is_due = false;
bool is_over = false;

int ask(int port) {
  const unsigned char request[] = {1, 3, 0, 1, 0, 1, 0xD5, 0xCA};
  unsigned char answer[7];
  std::size_t got = 0;
  if (write(port, request, sizeof request) != sizeof request) return -1;
  while (got < sizeof answer) {
    pollfd entry{port, POLLIN, 0};
    if (poll(&entry, 1, 500) <= 0) return -1;
    const ssize_t size = read(port, answer + got, sizeof answer - got);
    if (size <= 0) return -1;
    got += static_cast<std::size_t>(size);
  }
  return answer[3] << 8 | answer[4];
}

int main() {
  const int port = open(std::getenv("UNDERSTUDY_PORT"), O_RDWR | O_NOCTTY);
  termios settings{};
  tcgetattr(port, &settings);
  cfmakeraw(&settings);
  cfsetspeed(&settings, B19200);
  tcsetattr(port, TCSANOW, &settings);
  std::thread clock([] {
    for (int i = 0; i < 10; ++i) {
      std::this_thread::sleep_for(std::chrono::seconds(std::atoi(std::getenv("PAUSE_S"))));
      const std::scoped_lock lock(mutex);
      is_due = true;
      changed.notify_all();
    }
  });
  std::thread teller([] {
    std::unique_lock lock(mutex);
    int reported = 0;
    while (!is_over) {
      if (!changed.wait_for(lock, std::chrono::milliseconds(2300),
                            [&] { return polled > reported || is_over; }))
        continue;
      reported = polled;
      std::printf("%d\n", reported);
    }
  });
  for (int i = 0; i < 10; ++i) {
    std::unique_lock lock(mutex);
    changed.wait(lock, [] { return is_due; });
    is_due = false;
    lock.unlock();
    const int value = ask(port);
    lock.lock();
    polled = value == 49153 ? i + 1 : -1;
    changed.notify_all();
  }
  clock.join();
  {
    const std::scoped_lock lock(mutex);
    is_over = true;
    changed.notify_all();
  }
  teller.join();
  std::printf("end\n");
}
