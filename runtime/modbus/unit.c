/* SPDX-License-Identifier: MIT
 *
 * unit - accounts of one unit.
 */
#include "modbus/unit.h"

#include <string.h>

bool unit_is_away(const struct unit *unit)
{
	return unit->fails > 0;
}

bool unit_is_bad(const struct unit *unit)
{
	return unit->fails >= UNIT_FAILS;
}

static void owe(struct unit *unit, const struct pdu *request, int64_t sent_ns)
{
	struct unit_owed *oldest = &unit->owed[0];

	for (int i = 1; i < UNIT_OWED; i++)
		if (unit->owed[i].sent_ns < oldest->sent_ns)
			oldest = &unit->owed[i];
	if (oldest->sent_ns && sent_ns - oldest->sent_ns < unit->late_ns)
		unit->unsure_ns = oldest->sent_ns + unit->late_ns;
	oldest->sent_ns = sent_ns;
	memcpy(oldest->head, request->byte, sizeof(oldest->head));
	oldest->crc = pdu_crc(request->byte, request->len);
}

void unit_silent(struct unit *unit, const struct pdu *owed, int64_t sent_ns, int64_t now_ns)
{
	if (owed && unit->late_ns)
		owe(unit, owed, sent_ns);
	unit->wait_ns = unit->fails == 0 ? UNIT_AGAIN_NS : unit->wait_ns * 2;
	if (unit->wait_ns > UNIT_MOST_NS)
		unit->wait_ns = UNIT_MOST_NS;
	if (unit->fails < UNIT_FAILS)
		unit->fails++;
	unit->again_ns = now_ns + unit->wait_ns;
}

static bool is_recent(const struct unit *unit, const struct unit_owed *owed, int64_t sent_ns)
{
	return owed->sent_ns && sent_ns - owed->sent_ns < unit->late_ns;
}

/* Whether @answer can be the answer to a request before. */
static bool may_belong(const struct unit_owed *owed, const struct pdu *answer)
{
	struct pdu before = { .len = (int)sizeof(owed->head) };
	int exception;

	memcpy(before.byte, owed->head, sizeof(owed->head));
	return pdu_check(&before, answer, &exception) != PDU_WRONG;
}

enum unit_trust unit_answered(struct unit *unit, const struct pdu *request, const struct pdu *answer,
			      int64_t sent_ns, int64_t now_ns)
{
	const uint16_t crc = pdu_crc(request->byte, request->len);
	enum unit_trust trust = sent_ns < unit->unsure_ns ? TRUST_NOTHING : TRUST_ALL;

	unit->fails = 0;
	unit->again_ns = 0;
	for (int i = 0; i < UNIT_OWED; i++) {
		struct unit_owed *owed = &unit->owed[i];

		if (!is_recent(unit, owed, sent_ns))
			continue;
		if (owed->crc != crc && may_belong(owed, answer))
			trust = TRUST_NOTHING;
		else if (owed->crc == crc && trust == TRUST_ALL)
			trust = TRUST_IT;
		/* Which of the two requests it answers is not known. */
		if (owed->crc == crc)
			owed->sent_ns = sent_ns;
	}
	if (trust == TRUST_NOTHING) {
		unit->counts.late++;
		unit->again_ns = now_ns + unit->late_ns;
		owe(unit, request, sent_ns);
	}
	return trust;
}

/* The form of the answer to a read: its function and length. Two reads of one form have answers that look alike. */
static int form(const uint8_t *request)
{
	const int count = pdu_word(request + 3);

	return request[0] << 8 | (request[0] <= PDU_DISCRETE_INPUTS ? (count + 7) / 8 : count);
}

bool unit_is_twin(const struct pdu *request, enum io_table table, uint16_t first, int count)
{
	struct pdu other;

	pdu_read(&other, table, first, count);
	return form(request->byte) == form(other.byte) && memcmp(request->byte, other.byte, 5) != 0;
}

int64_t unit_clear_ns(const struct unit *unit, enum io_table table, uint16_t first, int count)
{
	struct pdu request;
	int64_t clear_ns = unit->unsure_ns;

	pdu_read(&request, table, first, count);
	for (int i = 0; i < UNIT_OWED; i++) {
		const struct unit_owed *owed = &unit->owed[i];

		if (owed->sent_ns && form(owed->head) == form(request.byte) &&
		    memcmp(owed->head, request.byte, 5) != 0 && owed->sent_ns + unit->late_ns > clear_ns)
			clear_ns = owed->sent_ns + unit->late_ns;
	}
	return clear_ns;
}

int64_t unit_due_ns(const struct unit *unit, bool alone)
{
	if (alone && unit->fails && unit->wait_ns > UNIT_ALONE_NS)
		return unit->again_ns - unit->wait_ns + UNIT_ALONE_NS;
	return unit->again_ns;
}
