/* SPDX-License-Identifier: MIT
 *
 * guard_fake - a chip that several processes share: gpiochip0 with the lines IN0, IN1, OUT0, OUT1 …,
 * label "panel". Linked with --wrap for open, close, ioctl, opendir, poll, syscall and waitpid into ladderd and
 * ladder-guard.
 *
 *   FAKE_DEV     folder in place of /dev; it holds an empty file gpiochip0
 *   FAKE_LINES   how many lines (6)
 *   FAKE_BUSY    a file that another process has open, as a watchdog device
 *   FAKE_EARLY   a signal that comes while ladderd is loaded, before main()
 *   FAKE_INTERRUPTED  how many calls of poll() a signal interrupts first
 *   FAKE_NO_PIDFD  if set, the kernel knows no pidfd_open()
 *   FAKE_SHARED  file of the lines: for each 56 bytes: int64 ns of CLOCK_MONOTONIC of its last
 *                write, int32 level, char[20] consumer, int64 ns and level when ladder-guard
 *                took it last, int64 how often its level has changed. Then an int64: 0 reads
 *                work, 1 they fail, 2 they wait until it is another number, 3 so, and nothing but
 *                SIGKILL interrupts them. Then an int64: 1 ladder-guard stops, as by SIGSTOP, before
 *                it next asks whether ladderd has ended; an int64: ns of CLOCK_MONOTONIC at which a
 *                read began to wait
 *
 * A line is locked by a lock of POSIX on its byte, which the kernel takes back when its process
 * dies, at the same moment as it would close the request of a line.
 */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define FIRST_OUT 2
#define CHIP_FD  2000
#define LINES_FD 2001
#define MOST     16

struct shared {
	int64_t written_ns;
	int32_t level;
	char owner[20];
	int64_t guard_ns; /* when ladder-guard took it last                      */
	int64_t guard_level;
	int64_t changes;
};
struct taken {
	uint32_t count, offset[GPIO_V2_LINES_MAX];
};

int __real_open(const char *path, int flags, ...);
int __real_close(int fd);
int __real_ioctl(int fd, unsigned long what, ...);
DIR *__real_opendir(const char *path);
int __wrap_open(const char *path, int flags, ...);
int __wrap_open64(const char *path, int flags, ...) __attribute__((alias("__wrap_open")));
int __wrap_close(int fd);
int __wrap_ioctl(int fd, unsigned long what, ...);
DIR *__wrap_opendir(const char *path);
long __real_syscall(long number, ...);
long __wrap_syscall(long number, ...);
int __real_poll(struct pollfd *fd, nfds_t count, int timeout);
int __wrap_poll(struct pollfd *fd, nfds_t count, int timeout);
pid_t __real_waitpid(pid_t pid, int *status, int how);
pid_t __wrap_waitpid(pid_t pid, int *status, int how);

static volatile struct shared *line;
static volatile int64_t *reads; /* how; whether the guard stops; since when one waits */
static uint32_t lines = 6;
static int file = -1;
static struct taken taken[MOST];

__attribute__((constructor)) static void begin(void)
{
	const char *path = getenv("FAKE_SHARED"), *count = getenv("FAKE_LINES");

	if (count)
		lines = (uint32_t)strtoul(count, NULL, 10);
	file = path ? __real_open(path, O_RDWR | O_CLOEXEC) : -1;
	if (file >= 0)
		line = mmap(NULL, lines * sizeof(*line) + 3 * sizeof(*reads), PROT_READ | PROT_WRITE,
			    MAP_SHARED, file, 0);
	if (file < 0 || line == MAP_FAILED)
		abort();
	reads = (volatile int64_t *)(line + lines);
	if (getenv("FAKE_EARLY"))
		raise(atoi(getenv("FAKE_EARLY")));
}

int __wrap_poll(struct pollfd *fd, nfds_t count, int timeout)
{
	static int interrupted;
	const char *times = getenv("FAKE_INTERRUPTED");

	if (times && interrupted < atoi(times)) {
		interrupted++;
		return errno = EINTR, -1;
	}
	return __real_poll(fd, count, timeout);
}

long __wrap_syscall(long number, ...)
{
	va_list args;
	long a, b, c, d;

	va_start(args, number);
	a = va_arg(args, long);
	b = va_arg(args, long);
	c = va_arg(args, long);
	d = va_arg(args, long);
	va_end(args);
	if (number == 434 && getenv("FAKE_NO_PIDFD"))
		return errno = ENOSYS, -1;
	return __real_syscall(number, a, b, c, d);
}

pid_t __wrap_waitpid(pid_t pid, int *status, int how)
{
	if (reads[1]) {
		reads[1] = 0;
		raise(SIGSTOP);
	}
	return __real_waitpid(pid, status, how);
}

DIR *__wrap_opendir(const char *path)
{
	return __real_opendir(strcmp(path, "/dev") == 0 ? getenv("FAKE_DEV") : path);
}

int __wrap_open(const char *path, int flags, ...)
{
	const char *busy = getenv("FAKE_BUSY");
	va_list args;
	int mode;

	if (busy && strcmp(path, busy) == 0)
		return errno = EBUSY, -1;
	va_start(args, flags);
	mode = flags & O_CREAT ? va_arg(args, int) : 0;
	va_end(args);
	return strstr(path, "/gpiochip0") ? CHIP_FD : __real_open(path, flags, mode);
}

static int lock(uint32_t at, short type, int command, struct flock *out)
{
	*out = (struct flock){ .l_type = type, .l_whence = SEEK_SET, .l_start = at, .l_len = 1 };
	return fcntl(file, command, out);
}

int __wrap_close(int fd)
{
	struct taken *of = fd >= LINES_FD && fd < LINES_FD + MOST ? &taken[fd - LINES_FD] : NULL;
	struct flock flock;

	if (fd == CHIP_FD)
		return 0;
	for (uint32_t i = 0; of && i < of->count; i++)
		lock(of->offset[i], F_UNLCK, F_SETLK, &flock);
	if (!of)
		return __real_close(fd);
	of->count = 0;
	return 0;
}

static bool is_mine(uint32_t at)
{
	for (int i = 0; i < MOST; i++)
		for (uint32_t k = 0; k < taken[i].count; k++)
			if (taken[i].offset[k] == at)
				return true;
	return false;
}

static bool is_used(uint32_t at)
{
	struct flock flock;

	return is_mine(at) || (lock(at, F_WRLCK, F_GETLK, &flock) == 0 && flock.l_type != F_UNLCK);
}

static int64_t clock_now(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void write_level(uint32_t at, int level)
{
	line[at].changes += line[at].level != level;
	line[at].level = level;
	line[at].written_ns = clock_now();
}

static int take(struct gpio_v2_line_request *ask)
{
	struct flock flock;
	int free_one = 0;

	while (free_one < MOST && taken[free_one].count)
		free_one++;
	if (free_one == MOST)
		return errno = EMFILE, -1;
	for (uint32_t i = 0; i < ask->num_lines; i++)
		if (is_used(ask->offsets[i]))
			return errno = EBUSY, -1;
	for (uint32_t i = 0; i < ask->num_lines; i++) {
		const uint32_t at = ask->offsets[i];

		if (lock(at, F_WRLCK, F_SETLK, &flock) != 0) {
			while (i-- > 0)
				lock(ask->offsets[i], F_UNLCK, F_SETLK, &flock);
			return errno = EBUSY, -1;
		}
		taken[free_one].offset[i] = at;
	}
	taken[free_one].count = ask->num_lines;
	for (uint32_t i = 0; i < ask->num_lines; i++) {
		memcpy((char *)line[ask->offsets[i]].owner, ask->consumer, 19);
		for (uint32_t k = 0; k < ask->config.num_attrs; k++)
			if (ask->config.attrs[k].attr.id == GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES)
				write_level(ask->offsets[i],
					    ask->config.attrs[k].attr.values >> i & 1);
		if (strcmp(ask->consumer, "ladder-guard") == 0) {
			line[ask->offsets[i]].guard_level = line[ask->offsets[i]].level;
			line[ask->offsets[i]].guard_ns = line[ask->offsets[i]].written_ns;
		}
	}
	ask->fd = LINES_FD + free_one;
	return 0;
}

static int about(struct gpio_v2_line_info *out)
{
	const bool output = out->offset >= FIRST_OUT;

	if (out->offset >= lines)
		return errno = EINVAL, -1;
	snprintf(out->name, sizeof(out->name), output ? "OUT%u" : "IN%u",
		 (unsigned)out->offset - (output ? FIRST_OUT : 0));
	out->flags = output ? GPIO_V2_LINE_FLAG_OUTPUT : GPIO_V2_LINE_FLAG_INPUT;
	if (is_used(out->offset)) {
		out->flags |= GPIO_V2_LINE_FLAG_USED;
		memcpy(out->consumer, (const char *)line[out->offset].owner, 20);
	}
	return 0;
}

/* A driver that waits for its hardware. */
static int wait_for_read(void)
{
	static const struct timespec moment = { 0, 1000000 };
	const int64_t how = *reads;
	sigset_t all;

	if (how >= 2 && !reads[2]) /* the first start that waits; ladder-guard starts it again */
		reads[2] = clock_now();
	sigfillset(&all);
	if (how == 3)
		sigprocmask(SIG_BLOCK, &all, NULL);
	while (how >= 2 && *reads == how)
		nanosleep(&moment, NULL);
	return how == 1 ? (errno = EIO, -1) : 0;
}

static int values(const struct taken *of, struct gpio_v2_line_values *values_of, bool set)
{
	if (!set && wait_for_read() < 0)
		return -1;
	for (uint32_t i = 0; i < of->count; i++) {
		const uint64_t mask = UINT64_C(1) << i;

		if (set && values_of->mask & mask)
			write_level(of->offset[i], !!(values_of->bits & mask));
		else if (!set)
			values_of->bits = (values_of->bits & ~mask) |
					  (line[of->offset[i]].level ? mask : 0);
	}
	return 0;
}

int __wrap_ioctl(int fd, unsigned long what, ...)
{
	va_list args;
	void *with;

	va_start(args, what);
	with = va_arg(args, void *);
	va_end(args);
	if (fd == CHIP_FD && what == GPIO_GET_CHIPINFO_IOCTL) {
		memcpy(((struct gpiochip_info *)with)->label, "panel", sizeof("panel"));
		((struct gpiochip_info *)with)->lines = lines;
		return 0;
	}
	if (fd == CHIP_FD && what == GPIO_V2_GET_LINEINFO_IOCTL)
		return about(with);
	if (fd == CHIP_FD && what == GPIO_V2_GET_LINE_IOCTL)
		return take(with);
	if (fd >= LINES_FD && fd < LINES_FD + MOST)
		return values(&taken[fd - LINES_FD], with, what == GPIO_V2_LINE_SET_VALUES_IOCTL);
	return __real_ioctl(fd, what, with);
}
