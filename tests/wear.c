/* SPDX-License-Identifier: MIT
 *
 * wear - what --retain writes in 30 days, when a retained word changes in every scan, and when
 * none changes.
 *
 * The thread of store_thread.c runs in virtual time: its poll() scans once, and moves the clock
 * by the time that it would have waited. Then random edits of the declarations: what has kept
 * its name and type keeps its value, everything else begins anew.
 */
#define _GNU_SOURCE /* mkdtemp() */
#include "ladderd/control.h"
#include "engine/scan/retain.h"
#include "ladderd/store.h"
#include "tests/unit/rig.h"

#include <poll.h>
#include <semaphore.h>
#include <stdatomic.h>
#include <time.h>
#include <unistd.h>

#define SECOND INT64_C(1000000000)
#define DAY    (86400 * SECOND)
#define PERIOD (10 * SECOND)
#define DAYS   30
#define EDITS  300
#define VARS   12

static char folder[] = "/tmp/wearXXXXXX", path[64];
static struct rig rig;
static struct store *store;
static _Atomic int64_t now_ns = SECOND;
static int64_t until_ns;
static bool changes, runs;
static sem_t done;
static unsigned long commits, written;
static struct location a;
static int32_t word;

int __wrap_clock_gettime(clockid_t clock, struct timespec *out);
int __real_poll(struct pollfd *ready, nfds_t count, int ms);
int __wrap_poll(struct pollfd *ready, nfds_t count, int ms);
int __wrap_fdatasync(int fd);
ssize_t __real_pwrite(int fd, const void *bytes, size_t len, off_t at);
ssize_t __wrap_pwrite(int fd, const void *bytes, size_t len, off_t at);
ssize_t __real_pwrite64(int fd, const void *bytes, size_t len, off_t at);
ssize_t __wrap_pwrite64(int fd, const void *bytes, size_t len, off_t at);

int __wrap_clock_gettime(clockid_t clock, struct timespec *out)
{
	(void)clock;
	*out = (struct timespec){ now_ns / SECOND, now_ns % SECOND };
	return 0;
}

int __wrap_poll(struct pollfd *ready, nfds_t count, int ms)
{
	if (!runs)
		return __real_poll(ready, count, ms);
	if (now_ns >= until_ns) {
		runs = false;
		sem_post(&done);
		return __real_poll(ready, count, -1);
	}
	now_ns += ms * INT64_C(1000000);
	if (changes)
		image_set(&rig.resource.image, a, (union iec_value){ .i = ++word });
	store_take(store, &rig.resource.image, now_ns);
	return 0;
}

int __wrap_fdatasync(int fd)
{
	(void)fd;
	commits++;
	return 0;
}

ssize_t __wrap_pwrite(int fd, const void *bytes, size_t len, off_t at)
{
	written += len;
	return __real_pwrite(fd, bytes, len, at);
}

ssize_t __wrap_pwrite64(int fd, const void *bytes, size_t len, off_t at)
{
	written += len;
	return __real_pwrite64(fd, bytes, len, at);
}

void control_tell(const char *what)
{
	fprintf(stderr, "%s\n", what);
}

void control_tell_error(const char *what, const char *why)
{
	fprintf(stderr, "%s: %s\n", what, why);
}

static struct store *open_store(struct arena *arena, bool quiet)
{
	const struct store_wish wish = { .path = path, .period_ns = PERIOD, .quiet = quiet };
	int status;

	arena_init(arena);
	return store_open(&wish, &rig.resource.image, arena, &status);
}

/* The thread goes on in virtual time, from the next call of poll() on. */
static void let_run(int64_t ns, bool change)
{
	until_ns = now_ns + ns;
	changes = change;
	commits = written = 0;
	runs = true;
}

static void wear(void)
{
	struct arena arena;
	struct retain retain;
	unsigned long most = (unsigned long)(DAYS * DAY / PERIOD), bytes;

	if (!rig_open(&rig, "VAR_GLOBAL RETAIN\n  A : DINT;\nEND_VAR\nPROGRAM Main LD\n"
		      "RUNG\n  | [ A := A + 1 ] |\nEND_PROGRAM\n", false))
		return;
	a = rig_at(&rig, "A");
	store = open_store(&arena, true);
	if (!CHECK(store && retain_plan(&retain, &rig.resource.image, &arena)))
		return;
	bytes = sizeof(struct retain_slot) + retain.payload_size + 4;
	let_run(DAYS * DAY, true);
	if (!CHECK(store_begin(store) == 0))
		return;
	sem_wait(&done);
	printf("# %d days: %lu commits, %lu bytes; a copy has %lu\n", DAYS, commits, written, bytes);
	CHECK_AS(commits <= most + 1, "at most one commit in each period");
	CHECK_AS(commits > most * 9 / 10, "and one in nearly each of them");
	CHECK_AS(written <= most * bytes * 12 / 10, "not a fifth more bytes than the copies have");
	store_close(store);
	arena_free(&arena);
	rig_set(&rig, "A", word);
	store = open_store(&arena, true);
	if (!CHECK(store != NULL))
		return;
	store_restore(store, &rig.resource, now_ns);
	CHECK_AS(rig_get(&rig, "A") == word, "the last value is kept");
	let_run(DAY, false);
	CHECK(store_begin(store) == 0);
	sem_wait(&done);
	CHECK_AS(!commits && !written, "nothing is written if nothing changes");
	store_close(store);
	arena_free(&arena);
	rig_close(&rig);
	unlink(path);
}

/* ---- other declarations ---- */

static const char *const type[] = { "INT", "DINT", "LINT" };
static int has[VARS]; /* 0: not declared; 1 + its type                    */
static unsigned seed = 1;

static unsigned draw(unsigned below)
{
	seed = seed * 1664525u + 1013904223u;
	return (seed >> 8) % below;
}

static void declare(void)
{
	char text[2000] = "VAR_GLOBAL RETAIN\n  Always : DINT;\n";
	const unsigned first = draw(VARS); /* in any order */

	for (unsigned i = 0; i < VARS; i++) {
		const unsigned var = (first + i) % VARS;

		if (has[var])
			snprintf(text + strlen(text), sizeof(text) - strlen(text),
				 "  V%u : %s;\n", var, type[has[var] - 1]);
	}
	snprintf(text + strlen(text), sizeof(text) - strlen(text), "END_VAR\nPROGRAM Main LD\n"
		 "RUNG\n  | [ Always := Always + 1 ] |\nEND_PROGRAM\n");
	rig_open(&rig, text, false);
}

static int value_of(unsigned var)
{
	char name[8];

	snprintf(name, sizeof(name), "V%u", var);
	return (int)rig_get(&rig, name);
}

static void edit(void)
{
	int wrong = 0, kept = 0, flags = 0;
	int was[VARS], value[VARS] = { 0 };

	for (int n = 0; n < EDITS; n++) {
		struct arena arena;
		bool lost = false;

		memcpy(was, has, sizeof(was));
		for (unsigned i = 0; i < 3; i++)
			has[draw(VARS)] = (int)draw(4);
		declare();
		store = open_store(&arena, true);
		if (!store)
			abort();
		store_restore(store, &rig.resource, now_ns);
		for (unsigned i = 0; i < VARS; i++) {
			const bool same = was[i] && was[i] == has[i];
			char name[8];

			lost |= was[i] && !same;
			kept += same;
			wrong += has[i] && value_of(i) != (same ? value[i] : 0);
			value[i] = 1 + (int)draw(30000);
			snprintf(name, sizeof(name), "V%u", i);
			if (has[i])
				rig_set(&rig, name, value[i]);
		}
		flags += rig.resource.retain_lost != lost || rig.resource.retain_old_copy;
		rig_set(&rig, "Always", n + 1);
		if (store_begin(store) != 0)
			abort();
		store_take(store, &rig.resource.image, now_ns);
		store_close(store);
		arena_free(&arena);
		rig_close(&rig);
	}
	printf("# %d values were kept\n", kept);
	CHECK_AS(!wrong && kept > EDITS, "what keeps its name and type keeps its value, everything else begins anew");
	CHECK_AS(!flags, "SYS_RETAIN_LOST tells when a value has gone, and only then");
}

int main(void)
{
	if (!mkdtemp(folder) || sem_init(&done, 0, 0) != 0)
		abort();
	snprintf(path, sizeof(path), "%s/keep", folder);
	wear();
	/* store_open() tells names that are lost: 300 edits have many. */
	if (!freopen("/dev/null", "w", stderr))
		abort();
	edit();
	unlink(path);
	rmdir(folder);
	return tap_done();
}
