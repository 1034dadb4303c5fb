/* SPDX-License-Identifier: MIT
 *
 * safe - signal handlers: requests, the watchdog timer, crashes. Handlers use only the
 * static objects below and what these point to.
 */
#define _GNU_SOURCE /* sigaltstack, setitimer, syscall */

#include "ladderd/safe.h"

#include "guard/say.h"
#include "hal/clock.h"
#include "ladderd/guarded.h"

#include <errno.h>
#include <poll.h>
#include <stdatomic.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

/* A handler has no argument for them. No other static objects of ladderd change. */
static struct requests requests;
static struct hal *volatile crash_hal;
static struct monitor *volatile watched;
static volatile sig_atomic_t tick_ms;

static void on_request(int signal_number)
{
	if (signal_number == SIGUSR1)
		requests.status = 1;
	else if (signal_number == SIGHUP)
		requests.reset = 1;
	else
		requests.stop = 1;
}

static void listen_to(int signal_number, void (*handler)(int))
{
	struct sigaction action;

	memset(&action, 0, sizeof(action));
	action.sa_handler = handler;
	sigemptyset(&action.sa_mask);
	sigaction(signal_number, &action, NULL);
}

static void mask_requests(int how)
{
	sigset_t set;

	sigemptyset(&set);
	sigaddset(&set, SIGINT);
	sigaddset(&set, SIGTERM);
	sigaddset(&set, SIGUSR1);
	sigaddset(&set, SIGHUP);
	sigprocmask(how, &set, NULL);
}

void requests_hold(void)
{
	mask_requests(SIG_BLOCK);
}

bool requests_end(void)
{
	sigset_t set;

	return sigpending(&set) == 0 && (sigismember(&set, SIGINT) == 1 || sigismember(&set, SIGTERM) == 1);
}

void requests_heed(void)
{
	mask_requests(SIG_UNBLOCK);
}

struct requests *requests_listen(void)
{
	listen_to(SIGINT, on_request);
	listen_to(SIGTERM, on_request);
	listen_to(SIGUSR1, on_request);
	listen_to(SIGHUP, on_request);
	listen_to(SIGPIPE, SIG_IGN);
	listen_to(SIGXFSZ, SIG_IGN); /* the write fails with EFBIG instead */
	return &requests;
}

void requests_attend(struct requests *asked)
{
	struct pollfd input = { .fd = STDIN_FILENO, .events = POLLIN };
	char thrown[64];

	if (!asked->attended || poll(&input, 1, 0) != 1)
		return;
	if (!(input.revents & POLLIN) || read(STDIN_FILENO, thrown, sizeof(thrown)) <= 0)
		asked->stop = 1;
}

/* setitimer() uses the monotonic clock, too; timer_create() would link thread code of the C
 * library. */
static int set_ticks(int64_t first_ns, int64_t limit_ns)
{
	struct itimerval tick;

	first_ns += 1000; /* 0 us would stop the timer */
	tick.it_value.tv_sec = first_ns / 1000000000;
	tick.it_value.tv_usec = first_ns % 1000000000 / 1000;
	tick.it_interval.tv_sec = limit_ns / 2 / 1000000000;
	tick.it_interval.tv_usec = limit_ns / 2 % 1000000000 / 1000;
	return setitimer(ITIMER_REAL, &tick, NULL) ? -errno : 0;
}

/* ns until the scan that runs is over its limit; without a scan more than between two ticks. */
static int64_t time_left(const struct monitor *monitor)
{
	const int64_t limit_ns = monitor->limit_ns;

	return atomic_load_explicit(&monitor->page->scan, memory_order_relaxed) & 1 ?
		monitor->began_ns + limit_ns - clock_now() : limit_ns;
}

/* Two ticks come in the time of a limit. The one at which a scan has less time left than until the next
 * one sets the next one to the end of that time, so scans that end soon set no timer. */
static void on_tick(int signal_number, siginfo_t *about, void *context)
{
	struct monitor *monitor = watched;
	int error = errno;
	int64_t left_ns;

	(void)signal_number, (void)context;
	if (about->si_code != SI_KERNEL || !monitor) /* sent by another process */
		return;
	left_ns = time_left(monitor);
	if (left_ns > 0) {
		if (left_ns < monitor->limit_ns / 2)
			set_ticks(left_ns, monitor->limit_ns);
		guarded_beat(tick_ms, false);
	} else {
		/* A guard that hears nothing more kills a ladderd whose scan hangs. */
		monitor->tripped = 1;
		hal_write_safe(monitor->hal);
		atomic_store(&monitor->page->safe, atomic_load(&monitor->page->scan));
		requests_attend(monitor->requests);
		if (monitor->requests->stop)
			_exit(1);
	}
	errno = error;
}

static int set_limit(struct monitor *monitor, int64_t limit_ns)
{
	const bool seen = limit_ns / 1000000 < GUARD_LONGEST;

	monitor->limit_ns = limit_ns;
	atomic_store(&monitor->page->limit, seen ? (uint32_t)(limit_ns / GUARD_TICK + 1) : 0);
	return set_ticks(limit_ns / 2, limit_ns);
}

/* In a time that is too long for the guard it waits for the longest that it takes. */
static void tell_limit(int64_t limit_ns)
{
	const int64_t ms = limit_ns / 2 / 1000000 + 1;
	const int was = tick_ms;

	tick_ms = ms < GUARDED_PAUSE_MS ? (int)ms : GUARDED_PAUSE_MS;
	guarded_beat(was > tick_ms ? was : tick_ms, true);
}

/* It cannot fail when it has worked once. */
void monitor_limit(int64_t limit_ns)
{
	set_limit(watched, limit_ns);
	tell_limit(limit_ns);
}

int monitor_start(struct monitor *monitor, struct hal *hal,
		  struct requests *asked, int64_t limit_ns)
{
	struct sigaction action;

	memset(monitor, 0, sizeof(*monitor));
	monitor->hal = hal;
	monitor->requests = asked;
	monitor->page = guarded_page();
	watched = monitor;
	memset(&action, 0, sizeof(action));
	action.sa_sigaction = on_tick;
	action.sa_flags = SA_SIGINFO | SA_RESTART;
	sigemptyset(&action.sa_mask);
	if (sigaction(SIGALRM, &action, NULL) != 0)
		return -errno;
	tell_limit(limit_ns);
	return set_limit(monitor, limit_ns);
}

void monitor_stop(struct monitor *monitor)
{
	static const struct itimerval never;

	atomic_store(&monitor->page->limit, 0);
	setitimer(ITIMER_REAL, &never, NULL);
	guarded_beat(GUARDED_PAUSE_MS, true);
	watched = NULL;
}

static void count_scan(struct monitor *monitor)
{
	_Atomic uint32_t *scan = &monitor->page->scan;

	atomic_store_explicit(scan, atomic_load_explicit(scan, memory_order_relaxed) + 1,
			      memory_order_release);
}

void monitor_begin(struct monitor *monitor, int64_t now_ns)
{
	monitor->began_ns = now_ns;
	atomic_store_explicit(&monitor->page->began, (uint32_t)(now_ns / GUARD_TICK),
			      memory_order_relaxed);
	count_scan(monitor);
}

void monitor_end(struct monitor *monitor)
{
	count_scan(monitor);
}

bool monitor_hangs(void)
{
	struct guard_page *page = guarded_page();
	const uint32_t scan = atomic_load(&page->scan);

	return (scan & 1) != 0 && atomic_load(&page->safe) == scan;
}

/* ---- safe points ---- */

static volatile int *volatile asked;
static int ask_timer = -1;

static void on_ask(int signal_number, siginfo_t *about, void *context)
{
	volatile int *ask = asked;

	(void)signal_number, (void)context;
	if (about->si_code == SI_TIMER && ask)
		*ask = 1;
}

/* As the kernel has them: timer_create() and timer_settime() would link thread code of the C
 * library, and a 32-bit library may have either size of time. */
static bool make_timer(void)
{
	struct sigaction action;
	struct sigevent event;

	memset(&action, 0, sizeof(action));
	action.sa_sigaction = on_ask;
	action.sa_flags = SA_SIGINFO | SA_RESTART;
	sigemptyset(&action.sa_mask);
	memset(&event, 0, sizeof(event));
	event.sigev_notify = SIGEV_SIGNAL;
	event.sigev_signo = SIGVTALRM;
	return sigaction(SIGVTALRM, &action, NULL) == 0 &&
	       syscall(SYS_timer_create, CLOCK_MONOTONIC, &event, &ask_timer) == 0;
}

#ifdef SYS_timer_settime64
#define WIDE_SETTIME SYS_timer_settime64
#else
#define WIDE_SETTIME (-1)
#endif
#ifdef SYS_timer_settime32
#define LONG_SETTIME SYS_timer_settime32
#else
#define LONG_SETTIME SYS_timer_settime
#endif

/* Kernels before 5.1 have times of a long only; so has a machine of 64 bits. */
static bool set_timer(int64_t first_ns, int64_t period_ns)
{
	const int64_t wide[4] = { period_ns / 1000000000, period_ns % 1000000000,
				  first_ns / 1000000000, first_ns % 1000000000 };
	const long old[4] = { (long)wide[0], (long)wide[1], (long)wide[2], (long)wide[3] };

	return (WIDE_SETTIME >= 0 &&
		syscall(WIDE_SETTIME, ask_timer, TIMER_ABSTIME, wide, NULL) == 0) ||
	       syscall(LONG_SETTIME, ask_timer, TIMER_ABSTIME, old, NULL) == 0;
}

bool safe_ask(volatile int *ask)
{
	asked = ask;
	if (ask && ask_timer < 0 && !make_timer())
		ask_timer = -1;
	return ask_timer >= 0 && set_timer(0, 0) && ask;
}

void safe_ask_from(int64_t first_ns, int64_t period_ns)
{
	set_timer(first_ns, period_ns);
}

/* SA_RESETHAND has restored the default action, so raise() ends the process. */
static void on_crash(int signal_number)
{
	struct hal *hal = crash_hal;

	crash_hal = NULL;
	if (hal)
		hal_write_safe(hal);
	raise(signal_number);
}

void safe_on_crash(struct hal *hal, void *stack)
{
	static const int deadly[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL,
				      SIGABRT };
	stack_t alternate = { .ss_sp = stack, .ss_size = SAFE_STACK_BYTES };
	struct sigaction action;

	crash_hal = stack ? hal : NULL;
	if (!stack || sigaltstack(&alternate, NULL) != 0)
		return;
	memset(&action, 0, sizeof(action));
	action.sa_handler = on_crash;
	action.sa_flags = (int)(SA_RESETHAND | SA_NODEFER | SA_ONSTACK);
	sigemptyset(&action.sa_mask);
	for (size_t i = 0; i < sizeof(deadly) / sizeof(deadly[0]); i++)
		sigaction(deadly[i], &action, NULL);
}
