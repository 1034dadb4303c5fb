/* SPDX-License-Identifier: MIT
 *
 * test_unit - which answer of a serial line is believed while others may still come, and when a unit is asked again.
 */
#include "modbus/unit.h"

#include "tests/tap.h"

#include <string.h>

#define MS INT64_C(1000000)

/* An answer to a read of registers, as @count 0s; 0: a refusal. */
static struct pdu answer_of(int function, int count)
{
	struct pdu out;

	memset(&out, 0, sizeof(out));
	out.byte[0] = (uint8_t)(count ? function : function | 0x80);
	out.byte[1] = (uint8_t)(count ? 2 * count : PDU_NO_ADDRESS);
	out.len = count ? 2 + 2 * count : 2;
	return out;
}

static void test_what_is_believed(void)
{
	static const struct {
		const char *what;
		int owed, count;    /* register and how many of the request without an answer */
		int asked, asked_count; /* of the next one                    */
		int64_t later_ms;
		bool refused;
		enum unit_trust trust;
	} rows[] = {
		{ "another form", 0, 2, 5, 1, 10, false, TRUST_ALL },
		{ "another register of the same form", 0, 1, 5, 1, 10, false, TRUST_NOTHING },
		{ "another register, when no answer is later", 0, 1, 5, 1, 501, false, TRUST_ALL },
		{ "the same request", 0, 1, 0, 1, 10, false, TRUST_IT },
		{ "the same request, much later", 0, 1, 0, 1, 501, false, TRUST_ALL },
		{ "a refusal may belong to any", 0, 2, 5, 1, 10, true, TRUST_NOTHING },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct unit unit = { .id = 1, .late_ns = UNIT_LATE_NS };
		struct pdu owed, request, answer = answer_of(3, rows[i].refused ? 0 : rows[i].asked_count);
		const int64_t then_ns = (1000 + rows[i].later_ms) * MS;
		enum unit_trust trust;

		pdu_read(&owed, TABLE_HOLDING_REGISTER, (uint16_t)rows[i].owed, rows[i].count);
		pdu_read(&request, TABLE_HOLDING_REGISTER, (uint16_t)rows[i].asked, rows[i].asked_count);
		unit_silent(&unit, &owed, 1000 * MS, 1100 * MS);
		trust = unit_answered(&unit, &request, &answer, then_ns, then_ns + MS);
		CHECK_AS(trust == rows[i].trust, rows[i].what);
		CHECK(!unit_is_away(&unit) && unit.counts.late == (trust == TRUST_NOTHING));
		CHECK(unit.again_ns == (trust == TRUST_NOTHING ? then_ns + MS + UNIT_LATE_NS : 0));
	}
}

/* More requests without an answer than are remembered: nothing is believed until the forgotten one cannot come any more. */
static void test_too_many_to_remember(void)
{
	struct unit unit = { .id = 1, .late_ns = UNIT_LATE_NS };
	struct pdu request, coils, answer = answer_of(3, 9);

	for (int i = 0; i <= UNIT_OWED; i++) {
		pdu_read(&request, TABLE_HOLDING_REGISTER, (uint16_t)i, 2);
		unit_silent(&unit, &request, (1000 + i) * MS, (1001 + i) * MS);
	}
	pdu_read(&request, TABLE_HOLDING_REGISTER, 0, 9);
	CHECK(unit_answered(&unit, &request, &answer, 1100 * MS, 1101 * MS) == TRUST_NOTHING);
	CHECK(unit_answered(&unit, &request, &answer, 1499 * MS, 1499 * MS) == TRUST_NOTHING);
	CHECK(unit.unsure_ns >= 1500 * MS);
	CHECK_AS(unit_answered(&unit, &request, &answer, unit.unsure_ns + UNIT_LATE_NS, unit.unsure_ns + UNIT_LATE_NS) == TRUST_ALL,
		 "later it is believed again");
	/* A unit of TCP says which request it answers: nothing is remembered. */
	unit = (struct unit){ .id = 1 };
	unit_silent(&unit, &request, 1000 * MS, 1100 * MS);
	CHECK(unit.owed[0].sent_ns == 0 && unit_answered(&unit, &request, &answer, 1101 * MS, 1102 * MS) == TRUST_ALL);
	/* Coils: their answers look alike if they have as many bytes. */
	unit = (struct unit){ .id = 1, .late_ns = UNIT_LATE_NS };
	pdu_read(&coils, TABLE_COIL, 0, 8);
	unit_silent(&unit, &coils, 1000 * MS, 1100 * MS);
	CHECK(unit_is_twin(&coils, TABLE_COIL, 8, 5) && !unit_is_twin(&coils, TABLE_COIL, 8, 9) && !unit_is_twin(&coils, TABLE_COIL, 0, 8));
	CHECK(unit_clear_ns(&unit, TABLE_COIL, 8, 5) == 1500 * MS && unit_clear_ns(&unit, TABLE_COIL, 8, 9) == 0);
	CHECK(unit_clear_ns(&unit, TABLE_COIL, 0, 8) == 0 && unit_clear_ns(&unit, TABLE_HOLDING_REGISTER, 8, 5) == 0);
}

/* 100 ms, 200 … 10 s; each second at most while nobody else answers. Two failures make its values bad. */
static void test_when_it_is_asked_again(void)
{
	struct unit unit = { .id = 1, .late_ns = UNIT_LATE_NS };
	struct pdu request, answer = answer_of(3, 1);
	int64_t wait_ns = UNIT_AGAIN_NS, now_ns = 1000 * MS;

	pdu_read(&request, TABLE_HOLDING_REGISTER, 0, 1);
	CHECK(unit_due_ns(&unit, true) == 0 && !unit_is_away(&unit));
	for (int i = 1; i <= 12; i++) {
		unit_silent(&unit, NULL, now_ns, now_ns);
		CHECK(unit_due_ns(&unit, false) == now_ns + wait_ns && unit_is_away(&unit) && unit_is_bad(&unit) == (i >= UNIT_FAILS));
		CHECK(unit_due_ns(&unit, true) == now_ns + (wait_ns < UNIT_ALONE_NS ? wait_ns : UNIT_ALONE_NS));
		now_ns += wait_ns;
		wait_ns = 2 * wait_ns < UNIT_MOST_NS ? 2 * wait_ns : UNIT_MOST_NS;
	}
	CHECK(unit_answered(&unit, &request, &answer, now_ns, now_ns) == TRUST_ALL && !unit_is_bad(&unit) && unit_due_ns(&unit, true) == 0);
	unit_silent(&unit, NULL, now_ns, now_ns);
	CHECK_AS(unit_due_ns(&unit, false) == now_ns + UNIT_AGAIN_NS, "from the beginning");
}

int main(void)
{
	test_what_is_believed();
	test_too_many_to_remember();
	test_when_it_is_asked_again();
	return tap_done();
}
