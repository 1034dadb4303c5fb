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
	if (oldest->sent_ns && sent_ns - oldest->sent_ns < UNIT_LATE_NS)
		unit->unsure_ns = oldest->sent_ns + UNIT_LATE_NS;
	oldest->sent_ns = sent_ns;
	memcpy(oldest->head, request->byte, sizeof(oldest->head));
	oldest->crc = pdu_crc(request->byte, request->len);
}

void unit_silent(struct unit *unit, const struct pdu *owed, int64_t sent_ns, int64_t now_ns)
{
	if (owed)
		owe(unit, owed, sent_ns);
	unit->wait_ns = unit->fails == 0 ? UNIT_AGAIN_NS : unit->wait_ns * 2;
	if (unit->wait_ns > UNIT_MOST_NS)
		unit->wait_ns = UNIT_MOST_NS;
	if (unit->fails < UNIT_FAILS)
		unit->fails++;
	unit->again_ns = now_ns + unit->wait_ns;
}

/* Whether @answer can be the answer to a request before, and that was another one. */
static bool may_belong(const struct unit_owed *owed, const struct pdu *request, const struct pdu *answer)
{
	struct pdu before = { .len = (int)sizeof(owed->head) };
	int exception;

	if (owed->crc == pdu_crc(request->byte, request->len))
		return false;
	memcpy(before.byte, owed->head, sizeof(owed->head));
	return pdu_check(&before, answer, &exception) != PDU_WRONG;
}

static bool is_doubtful(const struct unit *unit, const struct pdu *request, const struct pdu *answer,
			int64_t sent_ns)
{
	if (sent_ns < unit->unsure_ns)
		return true;
	for (int i = 0; i < UNIT_OWED; i++) {
		const struct unit_owed *owed = &unit->owed[i];

		if (owed->sent_ns && sent_ns - owed->sent_ns < UNIT_LATE_NS &&
		    may_belong(owed, request, answer))
			return true;
	}
	return false;
}

bool unit_answered(struct unit *unit, const struct pdu *request, const struct pdu *answer, bool numbered,
		   int64_t sent_ns, int64_t now_ns)
{
	unit->fails = 0;
	unit->again_ns = 0;
	if (numbered || !is_doubtful(unit, request, answer, sent_ns))
		return true;
	unit->counts.late++;
	unit->again_ns = now_ns + UNIT_AGAIN_NS;
	owe(unit, request, sent_ns);
	return false;
}

int64_t unit_due_ns(const struct unit *unit, bool alone)
{
	if (alone && unit->fails && unit->wait_ns > UNIT_ALONE_NS)
		return unit->again_ns - unit->wait_ns + UNIT_ALONE_NS;
	return unit->again_ns;
}
