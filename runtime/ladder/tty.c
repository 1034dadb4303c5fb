/* SPDX-License-Identifier: MIT
 *
 * tty - termios, signals and the clock, for the live tables of `ladder run` and `ladder
 * io`. Static variables are there for the signal handlers.
 */
#include "ladder/tty.h"

#include <errno.h>
#include <langinfo.h>
#include <locale.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/select.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

static volatile sig_atomic_t stopped, opened;
static struct termios before;

/* Second screen, no cursor, no wrapping; and the reverse. */
static const char enter[] = "\033[?1049h\033[?25l\033[?7l\033[2J";
static const char leave[] = "\033[0m\033[?7h\033[?25h\033[?1049l";

bool tty_is(void)
{
	const char *term = getenv("TERM");

	return isatty(STDIN_FILENO) && isatty(STDOUT_FILENO) && term &&
	       strcmp(term, "dumb") != 0;
}

bool tty_utf8(void)
{
	setlocale(LC_CTYPE, "");
	return strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
}

static void ask_to_stop(int number)
{
	(void)number;
	stopped = 1;
}

/* Calls only async-signal-safe functions (POSIX 2.4.3). */
static void restore(void)
{
	if (!opened)
		return;
	opened = 0;
	ssize_t written = write(STDOUT_FILENO, leave, sizeof(leave) - 1);

	(void)written;
	tcsetattr(STDIN_FILENO, TCSAFLUSH, &before);
}

static void die(int number)
{
	restore();
	raise(number);
}

static void watch(int number, void (*call)(int), int flags)
{
	struct sigaction action;

	memset(&action, 0, sizeof(action));
	action.sa_handler = call;
	action.sa_flags = flags;
	sigemptyset(&action.sa_mask);
	sigaction(number, &action, NULL);
}

void tty_watch_signals(void)
{
	static const int stop[] = { SIGINT, SIGTERM, SIGHUP, SIGQUIT };

	for (size_t i = 0; i < sizeof(stop) / sizeof(stop[0]); i++)
		watch(stop[i], ask_to_stop, 0);
}

bool tty_stopped(void)
{
	return stopped;
}

bool tty_open(void)
{
	static const int fatal[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT };
	struct termios raw;

	if (tcgetattr(STDIN_FILENO, &before) != 0)
		return false;
	raw = before;
	raw.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
	raw.c_iflag &= ~(tcflag_t)(IXON | ICRNL);
	raw.c_cc[VMIN] = 0;
	raw.c_cc[VTIME] = 0;
	raw.c_cc[VSUSP] = _POSIX_VDISABLE;
	for (size_t i = 0; i < sizeof(fatal) / sizeof(fatal[0]); i++)
		watch(fatal[i], die, (int)SA_RESETHAND);
	watch(SIGTSTP, SIG_IGN, 0);
	if (tcsetattr(STDIN_FILENO, TCSAFLUSH, &raw) != 0)
		return false;
	opened = 1;
	return tty_draw(enter, sizeof(enter) - 1);
}

void tty_close(void)
{
	restore();
}

void tty_size(int *width, int *height)
{
	struct winsize size;

	*width = 80;
	*height = 24;
	if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col &&
	    size.ws_row) {
		*width = size.ws_col;
		*height = size.ws_row;
	}
}

bool tty_draw(const char *bytes, size_t len)
{
	while (len) {
		ssize_t done = write(STDOUT_FILENO, bytes, len);

		if (done < 0 && errno == EINTR)
			continue;
		if (done <= 0)
			return false;
		bytes += done;
		len -= (size_t)done;
	}
	return true;
}

static struct timespec span(int64_t ns)
{
	if (ns < 0)
		ns = 0;
	return (struct timespec){ .tv_sec = (time_t)(ns / 1000000000),
				  .tv_nsec = (long)(ns % 1000000000) };
}

int tty_key(int64_t wait_ns)
{
	struct timespec wait = span(wait_ns);
	unsigned char bytes[64];
	ssize_t count;
	fd_set set;

	FD_ZERO(&set);
	FD_SET(STDIN_FILENO, &set);
	if (pselect(STDIN_FILENO + 1, &set, NULL, NULL, &wait, NULL) <= 0)
		return -1;
	count = read(STDIN_FILENO, bytes, 1);
	if (count <= 0)
		return count == 0 || errno != EINTR ? -2 : -1;
	if (bytes[0] != 27)
		return bytes[0];
	/* A sequence arrives whole; Esc alone is the key. */
	count = read(STDIN_FILENO, bytes, sizeof(bytes));
	return count > 0 ? -1 : 27;
}

void tty_sleep(int64_t wait_ns)
{
	struct timespec wait = span(wait_ns);

	pselect(0, NULL, NULL, NULL, &wait, NULL);
}

