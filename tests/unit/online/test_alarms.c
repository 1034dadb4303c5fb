/* SPDX-License-Identifier: MIT
 *
 * test_alarms - the list of alarms: which rows stay, what a chattering alarm costs, what restarts
 * and full rings do.
 */
#include "online/alarms.h"

#include "tests/unit/rig.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SECOND INT64_C(1000000000)

static struct alarm_list *list;

static void note(const char *name, uint8_t state, uint32_t times, int64_t time_ns)
{
	struct alarm_note note = { .state = state, .class = 1, .times = times, .time_ns = time_ns };

	snprintf(note.name, sizeof(note.name), "%s", name);
	alarm_list_note(list, &note);
}

static void begin(void)
{
	free(list);
	list = calloc(1, sizeof(*list));
}

static uint32_t rows(void)
{
	uint32_t count = 0;

	for (uint32_t i = 0; i < ALARM_ROWS; i++)
		count += list->row[i].number != 0;
	return count;
}

static const struct alarm_row *row_of(const char *name)
{
	for (uint32_t i = 0; i < ALARM_ROWS; i++)
		if (list->row[i].number && strcmp(list->row[i].name, name) == 0)
			return &list->row[i];
	return NULL;
}

static void test_states(void)
{
	const struct alarm_row *row;

	begin();
	note("Hot", ALARM_UNACK, 1, 10);
	row = row_of("Hot");
	CHECK(row->came_ns == 10);
	note("Hot", ALARM_GONE_UNACK, 0, 20);
	CHECK(row->went_ns == 20);
	alarm_list_ack(list, row->number, "ann", 30);
	CHECK(row->state == ALARM_NORMAL);
	CHECK(row->acked_ns == 30);
	CHECK(strcmp(row->who, "ann") == 0);
	note("Hot", ALARM_NORMAL, 0, 40);
	CHECK(strcmp(row->who, "ann") == 0); /* the block says later what is known */
	CHECK(row->acked_ns == 30);
	note("Hot", ALARM_UNACK, 1, 50);
	CHECK(row->times == 2);    /* within a minute: the same row */
	CHECK(row->went_ns == 0);
	CHECK(row->acked_ns == 0);
	note("Hot", ALARM_NORMAL, 0, 60);
	CHECK(row->acked_ns == 60); /* by the program */
	CHECK(strcmp(row->who, "") == 0);
	note("Hot", ALARM_UNACK, 1, 60 + 60 * SECOND);
	CHECK(rows() == 2);
}

/* An hour of an alarm that comes and goes in each scan of 10 ms, unacknowledged or a notice. */
static void test_chatter(void)
{
	begin();
	note("Other", ALARM_ACKED, 1, 0);
	note("Other", ALARM_NORMAL, 0, 1);
	for (int64_t i = 0; i < 360000; i++) {
		note("Loud", i % 2 ? ALARM_GONE_UNACK : ALARM_UNACK, 1 - i % 2, i * SECOND / 100);
		note("Quiet", i % 2 ? ALARM_NORMAL : ALARM_ACKED, 1 - i % 2, i * SECOND / 100);
	}
	CHECK(rows() == 3);
	CHECK(row_of("Loud")->times == 180000);
	CHECK(row_of("Quiet")->times == 180000);
	CHECK(row_of("Loud")->came_ns == 0);
}

static void test_10000_at_once(void)
{
	char name[16];

	begin();
	for (int i = 0; i < 100; i++) {
		snprintf(name, sizeof(name), "Old%d", i);
		note(name, ALARM_ACKED, 1, i);
		note(name, ALARM_NORMAL, 0, i);
	}
	for (int i = 0; i < 10000; i++) {
		snprintf(name, sizeof(name), "A%d", i);
		note(name, ALARM_UNACK, 1, i);
	}
	CHECK(rows() == ALARM_ROWS);
	CHECK(!row_of("Old99"));              /* what had finished made room */
	CHECK(row_of("A0") && row_of("A255")); /* what is active stays        */
	CHECK(list->lost == 10000 - 256);
	alarm_list_ack(list, row_of("A7")->number, "ann", 1);
	note("A7", ALARM_NORMAL, 0, 1);
	note("New", ALARM_UNACK, 1, 61 * SECOND);
	CHECK(row_of("New") && !row_of("A7"));
}

static void test_restart(void)
{
	struct alarm_note sync = { .sync = 1, .time_ns = 100 };

	begin();
	note("Gone", ALARM_UNACK, 1, 1);
	note("Seen", ALARM_ACKED, 1, 1);
	note("Again", ALARM_UNACK, 1, 1);
	note("Seen again", ALARM_ACKED, 1, 1);
	alarm_list_raise(list, ALARM_IO, true, 1);
	alarm_list_doubt(list, false);
	note("Again", ALARM_UNACK, 1, 90);
	note("Seen again", ALARM_UNACK, 1, 90); /* its block is not retained */
	alarm_list_note(list, &sync);
	CHECK(row_of("Gone")->state == ALARM_GONE_UNACK);
	CHECK(row_of("Gone")->went_ns == 100);
	CHECK(row_of("Seen")->state == ALARM_NORMAL);
	CHECK(row_of("Again")->state == ALARM_UNACK);
	CHECK(row_of("Seen again")->state == ALARM_UNACK);
	CHECK(row_of("SYS_IO_FAULT")->state == ALARM_UNACK); /* it is of the board, not of the program */
	alarm_list_doubt(list, true);
	alarm_list_note(list, &sync);
	CHECK(row_of("SYS_IO_FAULT")->state == ALARM_GONE_UNACK);
}

/* The blocks of a program, in instances and arrays, too; more changes in one scan than the ring
 * holds: the rest is told after the next scan. */
static void test_look(void)
{
	static char text[20000];
	static struct alarm_ring ring;
	struct alarm_note note;
	struct alarm_watch *watch;
	struct rig rig;
	size_t at = 0;
	int told = 0, syncs = 0;

	at += (size_t)snprintf(text, sizeof(text), "VAR\n  In AT %%IX0.0 : BOOL;\n  Line : OWN;\n");
	for (int i = 0; i < 100; i++)
		at += (size_t)snprintf(text + at, sizeof(text) - at, "  A%d : ALARM;\n", i);
	at += (size_t)snprintf(text + at, sizeof(text) - at, "END_VAR\nFUNCTION_BLOCK OWN LD\nVAR_INPUT\n  In : BOOL;\nEND_VAR\nVAR\n"
		"  Deep : EVENT;\nEND_VAR\nRUNG\n  | NO In | EVENT Deep MSG:='deep' |\nEND_FUNCTION_BLOCK\n"
		"PROGRAM Main LD\nRUNG\n  | NO In | OWN Line |\n");
	for (int i = 0; i < 100; i++)
		at += (size_t)snprintf(text + at, sizeof(text) - at, "RUNG\n  | NO In | ALARM A%d MSG:='m%d' |\n", i, i);
	snprintf(text + at, sizeof(text) - at, "END_PROGRAM\n");
	if (!rig_open(&rig, text, false))
		return;
	watch = alarm_watch_new(&rig.resource.image);
	CHECK(watch && watch->count == 101 && watch->left_out == 0);
	CHECK(alarm_block_find(watch, "Line.Deep") && !alarm_block_find(watch, "Line"));
	CHECK(alarm_block_ack(alarm_block_find(watch, "Line.Deep")).type == IEC_NONE);
	CHECK(alarm_block_ack(alarm_block_find(watch, "A7")).where ==
	      rig_at(&rig, "A7.OP_ACK").where);
	ring.watch = watch;
	alarm_look(&ring, &rig.resource);
	CHECK(!alarm_take(&ring, &note)); /* there was no scan yet */
	image_set_bit(&rig.resource.image, AREA_I, 0, true);
	rig_scan(&rig);
	alarm_look(&ring, &rig.resource);
	alarm_look(&ring, &rig.resource);
	for (int round = 0; round < 3; round++) {
		while (alarm_take(&ring, &note)) {
			told += !note.sync && note.times == 1;
			syncs += note.sync;
			CHECK(round || told <= (int)ALARM_RING);
		}
		alarm_look(&ring, &rig.resource);
	}
	CHECK(told == 101 && syncs == 1);
	resource_start(&rig.resource); /* counts begin again */
	image_set_bit(&rig.resource.image, AREA_I, 0, true);
	rig_scan(&rig);
	alarm_look(&ring, &rig.resource);
	while (alarm_take(&ring, &note))
		CHECK(note.times <= 1);
	free(watch);
	rig_close(&rig);
}

/* A program with more alarms than a board watches. */
static void test_more_blocks_than_are_watched(void)
{
	static char text[400000];
	struct alarm_watch *watch;
	struct rig rig;
	size_t at = 0;

	at += (size_t)snprintf(text, sizeof(text), "VAR\n  In : BOOL;\n");
	for (int i = 0; i < 5000; i++)
		at += (size_t)snprintf(text + at, sizeof(text) - at, "  A%d : ALARM;\n", i);
	at += (size_t)snprintf(text + at, sizeof(text) - at, "END_VAR\nPROGRAM Main LD\n");
	for (int i = 0; i < 5000; i++)
		at += (size_t)snprintf(text + at, sizeof(text) - at, "RUNG\n  | NO In | ALARM A%d |\n", i);
	snprintf(text + at, sizeof(text) - at, "END_PROGRAM\n");
	if (!rig_open(&rig, text, false))
		return;
	watch = alarm_watch_new(&rig.resource.image);
	CHECK(watch && watch->count == ALARM_MOST && watch->left_out == 5000 - ALARM_MOST);
	CHECK(alarm_block_find(watch, "A4095") && !alarm_block_find(watch, "A4096"));
	free(watch);
	rig_close(&rig);
}

static void take_all(struct alarm_ring *ring)
{
	struct alarm_note told;

	while (alarm_take(ring, &told))
		alarm_list_note(list, &told);
}

/* What a block counted before a download does not come again; a text that the download changed is in
 * the list at once. */
static void test_a_download_tells_no_alarm_twice(void)
{
	static const char text[] = "VAR\n  In AT %IX0.0 : BOOL;\n  Old, Hot : ALARM;\n  Note : EVENT;\n  Say : STRING[20] := 'hot';\n"
		"END_VAR\nPROGRAM Main LD\nRUNG\n  | NO In | ALARM Old MSG:='old' |\nRUNG\n  | NC In | ALARM Hot MSG:=Say |\n"
		"RUNG\n  | NO In | EVENT Note MSG:='note' |\nEND_PROGRAM\n";
	static struct alarm_ring ring;
	struct alarm_watch *before, *after;
	struct rig rig;

	if (!rig_open(&rig, text, false))
		return;
	begin();
	before = alarm_watch_new(&rig.resource.image);
	ring.watch = before;
	for (int i = 0; i < 5; i++) {
		image_set_bit(&rig.resource.image, AREA_I, 0, i % 2);
		rig_set(&rig, "Old.OP_ACK", 1);
		rig_scan(&rig);
		alarm_look(&ring, &rig.resource);
		take_all(&ring);
	}
	CHECK(row_of("Old")->times == 2 && row_of("Old")->state == ALARM_NORMAL && row_of("Note")->times == 2);
	CHECK(row_of("Hot")->times == 3 && row_of("Hot")->state == ALARM_UNACK);
	/* An hour later another program has the same blocks, with what they counted. */
	rig.now += 3600 * SECOND;
	after = alarm_watch_new(&rig.resource.image);
	alarm_watch_carry(after, before);
	note("Removed", ALARM_UNACK, 1, 1);
	alarm_list_doubt(list, false);
	ring.watch = after;
	snprintf((char *)image_get(&rig.resource.image, rig_at(&rig, "Say")).s->text, 4, "HOT");
	rig_scan(&rig);
	alarm_look(&ring, &rig.resource);
	take_all(&ring);
	CHECK(row_of("Removed")->state == ALARM_GONE_UNACK); /* the next program has no such block */
	CHECK(rows() == 4 && row_of("Old")->times == 2 && row_of("Note")->times == 2);
	CHECK(row_of("Hot")->times == 3 && row_of("Hot")->state == ALARM_UNACK && !row_of("Hot")->went_ns);
	CHECK_TEXT(row_of("Hot")->text, "HOT");
	free(before);
	free(after);
	rig_close(&rig);
}

/* What the board itself notices: a bit for the program, and an alarm that comes and goes with it. */
static void test_what_the_board_notices(void)
{
	static const char text[] = "VAR\n  Forced, Lost, Late, Lines : BOOL;\nEND_VAR\nPROGRAM Main LD\n"
		"RUNG\n  | NO SYS_FORCED_ANY | COIL Forced |\nRUNG\n  | NO SYS_RETAIN_LOST | COIL Lost |\n"
		"RUNG\n  | NO SYS_WD_LATE | COIL Late |\nRUNG\n  | NO SYS_IO_FAULT | COIL Lines |\nEND_PROGRAM\n";
	static const char *const names[] = { "SYS_FORCED_ANY", "SYS_RETAIN_LOST", "SYS_WD_LATE", "SYS_IO_FAULT" };
	static const char *const bits[] = { "Forced", "Lost", "Late", "Lines" };
	static struct alarm_ring ring;
	struct rig rig;

	if (!rig_open(&rig, text, false))
		return;
	begin();
	for (int i = 0; i < 4; i++) {
		rig_scan(&rig);
		alarm_look(&ring, &rig.resource);
		take_all(&ring);
		CHECK(!rig_get(&rig, bits[i]) && !row_of(names[i]));
		for (int on = 1; on >= 0; on--) {
			if (i == 0 && on)
				rig_force(&rig, "SYS_FIRST_SCAN", 0);
			else if (i == 0)
				rig_release(&rig, "SYS_FIRST_SCAN");
			*(i == 1 ? &rig.resource.retain_lost : i == 2 ? &rig.resource.late : &rig.resource.io_fault) = i && on;
			rig_scan(&rig);
			alarm_look(&ring, &rig.resource);
			take_all(&ring);
			CHECK(rig_get(&rig, bits[i]) == on && row_of(names[i])->class == 0);
			CHECK(row_of(names[i])->state == (i ? on ? ALARM_UNACK : ALARM_GONE_UNACK : on ? ALARM_ACKED : ALARM_NORMAL));
			CHECK((row_of(names[i])->went_ns == 0) == on && row_of(names[i])->times == 1);
		}
	}
	resource_fail(&rig.resource, FAULT_WATCHDOG);
	alarm_look(&ring, &rig.resource);
	take_all(&ring);
	CHECK(row_of("FAULT")->state == ALARM_UNACK);
	resource_start(&rig.resource);
	alarm_look(&ring, &rig.resource);
	take_all(&ring);
	CHECK(row_of("FAULT")->state == ALARM_GONE_UNACK && rows() == 5);
	rig_close(&rig);
}

static void test_bytes(void)
{
	static uint8_t bytes[ALARM_BYTES];
	struct alarm_row row = { .number = 5, .state = ALARM_UNACK, .class = 1, .came_ns = -1 }, got;
	uint32_t version;
	bool empty;

	memset(row.name, 'n', sizeof(row.name) - 1);
	memset(row.text, 't', sizeof(row.text) - 1);
	memset(row.who, 'w', sizeof(row.who) - 1);
	CHECK(!alarm_open(bytes, &got, &version, &empty) && empty);
	alarm_seal(&row, 9, bytes);
	CHECK(alarm_open(bytes, &got, &version, &empty) && !empty);
	CHECK(version == 9);
	CHECK(strcmp(got.text, row.text) == 0);
	CHECK(strcmp(got.who, row.who) == 0);
	for (uint32_t i = 0; i < ALARM_BYTES; i++) {
		bytes[i] ^= 1;
		if (alarm_open(bytes, &got, &version, &empty))
			CHECK(i == ALARM_BYTES);
		bytes[i] ^= 1;
	}
}

int main(void)
{
	test_states();
	test_chatter();
	test_10000_at_once();
	test_restart();
	test_bytes();
	test_look();
	test_more_blocks_than_are_watched();
	test_a_download_tells_no_alarm_twice();
	test_what_the_board_notices();
	free(list);
	return tap_done();
}
