/* SPDX-License-Identifier: MIT
 *
 * guest - tests ladderd on a real kernel with real lines.
 *
 *   guest [--tier full|small] [--only N] [--longest S] [--flips N]
 *         [--kills N] [--stops N] [--starts N] [--work DIR] CASES LADDERD...
 *   guest --as-user COMMAND...         helper: runs it as an ordinary user
 *   guest --late MS COMMAND...         helper: runs it after this time
 *   guest --memory BYTES COMMAND...    helper: runs it with little memory
 *   guest --held COMMAND...            helper: runs it under ptrace, held
 *
 * Every LADDERD runs through the same tests; results begin with the end of its
 * name (`ladderd-uapi`: "uapi: ..."). The tier `small` is for a ladderd that
 * reads code images only, on a kernel without users. TAP goes to stdout; the
 * exit status is 0 if all passed.
 */
#define _GNU_SOURCE /* setgroups */

#include "tests/targets/guest/guest.h"

#include "tests/targets/guest/bank.h"
#include "tests/targets/guest/child.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <grp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define SECOND INT64_C(1000000000)
#define NOBODY 65534

struct guest guest = { .work = "/tmp", .longest_ns = INT64_MAX, .flips = 64,
		       .kills = 10, .stops = 4, .starts = 4 };

static int count, failed;

static void vsay(const char *head, const char *format, va_list args)
{
	printf("%s %d - %s: ", head, ++count, guest.word);
	vprintf(format, args);
}

bool check(bool good, const char *format, ...)
{
	static const struct child last = { .slot = 0 };
	const char *said;
	va_list args;

	va_start(args, format);
	vsay(good ? "ok" : "not ok", format, args);
	va_end(args);
	printf("\n");
	failed += !good;
	if (!good) {
		said = child_err(&last);
		while (*said) {
			int len = (int)strcspn(said, "\n");

			printf("#   %.*s\n", len, said);
			said += len + (said[len] == '\n');
		}
	}
	fflush(stdout);
	return good;
}

void skip(const char *why, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	vsay("ok", format, args);
	va_end(args);
	printf(" # SKIP %s\n", why);
	fflush(stdout);
}

void note(const char *format, ...)
{
	va_list args;

	printf("# %s: ", guest.word);
	va_start(args, format);
	vprintf(format, args);
	va_end(args);
	printf("\n");
	fflush(stdout);
}

void give_up(const char *what)
{
	printf("Bail out! %s: %s\n", what, strerror(errno));
	fflush(stdout);
	exit(1);
}

int64_t clock_now(void)
{
	struct timespec now;

	if (clock_gettime(CLOCK_MONOTONIC, &now) != 0)
		give_up("clock_gettime");
	return now.tv_sec * SECOND + now.tv_nsec;
}

void sleep_until(int64_t at_ns)
{
	struct timespec until = { .tv_sec = at_ns / SECOND,
				  .tv_nsec = at_ns % SECOND };
	int error;

	do
		error = clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until,
					NULL);
	while (error == EINTR);
	if (error) {
		errno = error;
		give_up("clock_nanosleep");
	}
}

void sleep_ms(int64_t ms)
{
	sleep_until(clock_now() + ms * MS);
}

static const char *join(const char *folder, const char *name)
{
	static char paths[4][PATH_MOST];
	static unsigned next;
	char *path = paths[next++ % 4];

	if (snprintf(path, PATH_MOST, "%s/%s", folder, name) >= PATH_MOST)
		give_up("a path is too long");
	return path;
}

const char *file_put(const char *name, const void *bytes, size_t len)
{
	const char *path = join(guest.work, name);
	int fd;

	unlink(path);
	fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
	if (fd < 0 || write(fd, bytes, len) != (ssize_t)len)
		give_up(path);
	close(fd);
	return path;
}

const char *file_text(const char *name, const char *text)
{
	return file_put(name, text, strlen(text));
}

long file_take(const char *path, char *out, size_t room)
{
	int fd = open(path, O_RDONLY);
	size_t len = 0;
	ssize_t got = -1;

	if (fd < 0)
		return -1;
	while (len < room - 1 &&
	       (got = read(fd, out + len, room - 1 - len)) > 0)
		len += (size_t)got;
	close(fd);
	out[len] = 0;
	return got < 0 ? -1 : (long)len;
}

const char *file_case(const char *name)
{
	return join(guest.cases, name);
}

bool file_is_there(const char *path)
{
	return access(path, F_OK) == 0;
}

static int as_user(char **command)
{
	if (setgroups(0, NULL) != 0 || setgid(NOBODY) != 0 ||
	    setuid(NOBODY) != 0)
		give_up("setuid");
	execv(command[0], command);
	give_up(command[0]);
}

static int with_memory(const char *bytes, char **command)
{
	struct rlimit limit = { .rlim_cur = strtoul(bytes, NULL, 10) };

	limit.rlim_max = limit.rlim_cur;
	if (setrlimit(RLIMIT_AS, &limit) != 0)
		give_up("setrlimit");
	execv(command[0], command);
	give_up(command[0]);
}

static int late(const char *ms, char **command)
{
	sleep_ms(strtol(ms, NULL, 10));
	execv(command[0], command);
	give_up(command[0]);
}

/* Stops at its start, so that the parent can step it. */
static int held(char **command)
{
	if (ptrace(PTRACE_TRACEME, 0, NULL, NULL) != 0)
		return NO_PTRACE;
	raise(SIGSTOP);
	execv(command[0], command);
	give_up(command[0]);
}

static int usage(void)
{
	fprintf(stderr, "usage: guest [--tier full|small] [--only 1..15] "
		"[--longest S] [--flips N] [--kills N] [--stops N] [--starts N] [--work DIR] CASES LADDERD...\n");
	return 2;
}

/* Returns the index after the options; -1: wrong. */
static int read_options(int argc, char **argv)
{
	int i = 1;

	for (; i + 1 < argc && argv[i][0] == '-'; i += 2) {
		const char *value = argv[i + 1];

		if (strcmp(argv[i], "--tier") == 0 &&
		    (!strcmp(value, "full") || !strcmp(value, "small")))
			guest.small = value[0] == 's';
		else if (strcmp(argv[i], "--only") == 0)
			guest.only = (int)strtol(value, NULL, 10);
		else if (strcmp(argv[i], "--longest") == 0)
			guest.longest_ns = strtol(value, NULL, 10) * SECOND;
		else if (strcmp(argv[i], "--flips") == 0)
			guest.flips = (unsigned)strtoul(value, NULL, 10);
		else if (strcmp(argv[i], "--kills") == 0)
			guest.kills = (int)strtol(value, NULL, 10);
		else if (strcmp(argv[i], "--stops") == 0)
			guest.stops = (int)strtol(value, NULL, 10);
		else if (strcmp(argv[i], "--starts") == 0)
			guest.starts = (int)strtol(value, NULL, 10);
		else if (strcmp(argv[i], "--work") == 0)
			guest.work = value;
		else
			return -1;
	}
	return i + 1 < argc ? i : -1;
}

static const struct {
	int number;
	const char *title;
	void (*run)(void);
} tests[] = {
	{ 1, "lines by name and by chip, two maps", test_lines },
	{ 2, "scenarios of the samples through lines", test_samples },
	{ 3, "options of lines", test_options },
	{ 3, "safe values and ways out", test_ways_out },
	{ 4, "busy, unplugged, denied", test_faults },
	{ 5, "system calls a scan", test_calls },
	{ 6, "10,000 scans at 1 ms", test_steady },
	{ 8, "bad input", test_bad_input },
	{ 9, "memory of 1,000 rungs", test_memory },
	{ 10, "what ladder io shows", test_picture },
	{ 11, "a desk changes the program", test_link },
	{ 12, "a desk at a serial line, without names", test_serial },
	{ 13, "a guard, and a ladderd that dies or freezes", test_guard },
	{ 14, "starts, and how long they take", test_starts },
	{ 15, "values by drivers of the kernel", test_values },
	{ 16, "chips of a shipped map by drivers of the kernel", test_chips },
};

static void run_all(const char *ladderd)
{
	const char *name = strrchr(ladderd, '/');

	guest.ladderd = ladderd;
	guest.word = name ? name + 1 : ladderd;
	if (strncmp(guest.word, "ladderd-", 8) == 0)
		guest.word += 8;
	for (size_t i = 0; i < sizeof(tests) / sizeof(tests[0]); i++) {
		int64_t begin_ns = clock_now();

		if (guest.only && guest.only != tests[i].number)
			continue;
		note("-- %d: %s", tests[i].number, tests[i].title);
		tests[i].run();
		note("-- %d took %ld ms of this guest's time",
		     tests[i].number, (long)((clock_now() - begin_ns) / MS));
	}
}

/* In a guest, files may be those of the host. */
static void empty(const char *folder)
{
	DIR *files = opendir(folder);
	const struct dirent *file;

	if (!files)
		return;
	while ((file = readdir(files)) != NULL)
		if (file->d_name[0] != '.')
			unlink(join(folder, file->d_name));
	closedir(files);
	rmdir(folder);
}

int main(int argc, char **argv)
{
	static char folder[PATH_MOST];
	int first;

	guest.self = argv[0];
	guest.word = "guest";
	if (argc > 2 && strcmp(argv[1], "--as-user") == 0)
		return as_user(argv + 2);
	if (argc > 3 && strcmp(argv[1], "--memory") == 0)
		return with_memory(argv[2], argv + 3);
	if (argc > 3 && strcmp(argv[1], "--late") == 0)
		return late(argv[2], argv + 3);
	if (argc > 2 && strcmp(argv[1], "--held") == 0)
		return held(argv + 2);
	first = read_options(argc, argv);
	if (first < 0)
		return usage();
	if (!bank_can()) {
		printf("1..0 # SKIP no gpio-sim in this kernel "
		       "(CONFIG_GPIO_SIM, configfs mounted)\n");
		return 0;
	}
	snprintf(folder, sizeof(folder), "%s/guest-XXXXXX", guest.work);
	if (!mkdtemp(folder) || chmod(folder, 0755) != 0)
		give_up(folder);
	guest.work = folder;
	guest.cases = argv[first];
	note("tier %s", guest.small ? "small: without a reader of programs (code "
	     "images only), without users, without threads" :
	     "full: programs and code images, users, limits of memory");
	for (int i = first + 1; i < argc; i++) {
		guest.again = i > first + 1;
		run_all(argv[i]);
	}
	printf("1..%d\n", count);
	fflush(stdout);
	empty(folder);
	return count == 0 || failed;
}
