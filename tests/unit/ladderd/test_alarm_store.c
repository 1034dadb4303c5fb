/* SPDX-License-Identifier: MIT
 *
 * test_alarm_store - how often alarms are written, what a restart finds, and a disk that refuses.
 */
#define _DEFAULT_SOURCE /* mkdtemp() */
#include "ladderd/alarm_store.h"

#include "tests/tap.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#define SECOND INT64_C(1000000000)
#define HOUR_S 3600

static char folder[] = "/tmp/alarmsXXXXXX";
static struct alarm_store store;
static struct alarm_list list;

static void note(const char *name, uint8_t state, uint32_t times, int64_t time_ns)
{
	struct alarm_note note = { .state = state, .class = 1, .times = times, .time_ns = time_ns };

	snprintf(note.name, sizeof(note.name), "%s", name);
	alarm_list_note(&list, &note);
}

/* As if ladderd began: what the folder holds. */
static void restart(int64_t now_ns)
{
	memset(&store, 0, sizeof(store));
	memset(&list, 0, sizeof(list));
	alarm_store_open(&store, folder, &list, now_ns);
}

/* A board that never had an alarm. */
static void begin(void)
{
	char path[64];

	snprintf(path, sizeof(path), "%s/alarms", folder);
	unlink(path);
	restart(0);
}

/* Rows written so far: each write counts the version of its row. */
static uint32_t writes(void)
{
	uint32_t count = 0;

	for (uint32_t i = 0; i < ALARM_ROWS; i++)
		count += store.version[i];
	return count;
}

/* An alarm changes in each scan of 10 ms, for an hour. */
static void test_chatter_costs_few_writes(void)
{
	begin();
	for (int64_t i = 0; i < HOUR_S * 100; i++) {
		note("Loud", i % 2 ? ALARM_GONE_UNACK : ALARM_UNACK, 1 - (uint32_t)i % 2, i * SECOND / 100);
		alarm_store_write(&store, &list, i * SECOND / 100);
	}
	CHECK(writes() == HOUR_S / 10);
	CHECK(lseek(store.fd, 0, SEEK_END) <= (off_t)(2 * ALARM_BYTES));
	alarm_store_close(&store, &list);
	restart(0);
	CHECK(list.row[0].times == HOUR_S * 50 && list.row[0].state == ALARM_GONE_UNACK);
	alarm_store_write(&store, &list, 1000 * SECOND);
	CHECK(writes() == HOUR_S / 10 + 1); /* nothing changed: nothing is written */
	alarm_store_close(&store, &list);
}

/* 300 alarms that all change in each scan: 256 rows a time of 10 s, and none without a change. */
static void test_many_cost_few_writes(void)
{
	uint32_t before;
	char name[16];

	begin();
	before = writes();
	for (int64_t i = 0; i < 100 * 100; i++) {
		for (int k = 0; k < 300 && i % 100 == 0; k++) {
			snprintf(name, sizeof(name), "A%d", k);
			note(name, i / 100 % 2 ? ALARM_ACKED : ALARM_UNACK, 1 - (uint32_t)(i / 100 % 2), i * SECOND / 100);
		}
		alarm_store_write(&store, &list, i * SECOND / 100);
	}
	CHECK(writes() - before <= 10 * ALARM_ROWS && writes() - before > 9 * ALARM_ROWS);
	CHECK(lseek(store.fd, 0, SEEK_END) == (off_t)(2 * ALARM_ROWS * ALARM_BYTES));
	alarm_store_close(&store, &list);
}

/* Each record is torn in turn: the row before counts, and no other row suffers. */
static void test_a_torn_record(void)
{
	uint8_t before[ALARM_BYTES], torn[ALARM_BYTES];
	struct alarm_row kept[2];

	begin();
	note("One", ALARM_UNACK, 1, 1);
	note("Two", ALARM_UNACK, 1, 1);
	alarm_store_close(&store, &list);
	restart(0);
	note("One", ALARM_GONE_UNACK, 0, 2);
	alarm_store_write(&store, &list, SECOND);
	memcpy(kept, list.row, sizeof(kept));
	for (uint32_t k = 0; k < 2; k++) {
		const off_t at = (off_t)(k * ALARM_BYTES);

		CHECK(pread(store.fd, before, ALARM_BYTES, at) == (ssize_t)ALARM_BYTES);
		memcpy(torn, before, ALARM_BYTES);
		memset(torn + ALARM_BYTES / 2, 0x5a, ALARM_BYTES / 2);
		CHECK(pwrite(store.fd, torn, ALARM_BYTES, at) == (ssize_t)ALARM_BYTES);
		close(store.fd);
		restart(0);
		CHECK(strcmp(list.row[0].name, "One") == 0 &&
		      (list.row[0].state == ALARM_UNACK || list.row[0].state == ALARM_GONE_UNACK));
		CHECK(memcmp(&list.row[1], &kept[1], sizeof(kept[1])) == 0);
		CHECK(pwrite(store.fd, before, ALARM_BYTES, at) == (ssize_t)ALARM_BYTES);
	}
	/* Both are gone: the board says so, and keeps the rest. */
	CHECK(pwrite(store.fd, torn, ALARM_BYTES, 0) == (ssize_t)ALARM_BYTES);
	CHECK(pwrite(store.fd, torn, ALARM_BYTES, (off_t)ALARM_BYTES) == (ssize_t)ALARM_BYTES);
	close(store.fd);
	restart(7 * SECOND);
	CHECK(strcmp(list.row[1].name, "Two") == 0);
	CHECK(strcmp(list.row[0].name, "alarms") == 0 && list.row[0].state == ALARM_GONE_UNACK &&
	      list.row[0].class == 0 && list.row[0].came_ns == 7 * SECOND);
	alarm_store_close(&store, &list);
}

/* A disk that refuses loses nothing: it is written when the disk takes it again. */
static void test_a_disk_that_refuses(void)
{
	int good, bad;

	begin();
	bad = open("/dev/null", O_RDONLY);
	good = store.fd;
	store.fd = bad;
	note("Late", ALARM_UNACK, 1, 5);
	alarm_store_write(&store, &list, SECOND);
	CHECK(store.error && list.changed);
	store.fd = good;
	close(bad);
	alarm_store_write(&store, &list, 2 * SECOND);
	CHECK(store.error); /* not in each scan */
	alarm_store_write(&store, &list, SECOND + ALARM_STORE_NS);
	CHECK(!store.error && !list.changed);
	alarm_store_close(&store, &list);
	restart(0);
	CHECK(alarm_list_find(&list, list.last) && strcmp(alarm_list_find(&list, list.last)->name, "Late") == 0);
	alarm_store_close(&store, &list);
}

int main(void)
{
	char path[64];

	if (!mkdtemp(folder))
		return 1;
	test_chatter_costs_few_writes();
	test_many_cost_few_writes();
	test_a_torn_record();
	test_a_disk_that_refuses();
	snprintf(path, sizeof(path), "%s/alarms", folder);
	unlink(path);
	rmdir(folder);
	return tap_done();
}
