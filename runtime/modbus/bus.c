/* SPDX-License-Identifier: MIT
 *
 * bus - chooses the next request of a bus, makes it, and takes what comes.
 */
#include "modbus/bus.h"

#include <stdlib.h>
#include <string.h>

#define SILENT     257 /* status of a request: the unit does not answer      */
#define REFUSED_NS 1000000000 /* between two attempts at what a device refuses  */
#define LINE_AGAIN_NS 100000000
#define LINE_MOST_NS 1000000000

static bool is_bits(enum io_table table)
{
	return table == TABLE_COIL || table == TABLE_DISCRETE_INPUT;
}

bool bus_open(struct bus *bus, const struct iomap *map, int number, struct field *field,
	      struct wire wire)
{
	const int64_t late_ns = UNIT_LATE * map->net->bus[number].timeout_ns;

	memset(bus, 0, sizeof(*bus));
	bus->map = map;
	bus->number = number;
	bus->field = field;
	bus->wire = wire;
	if (!plan_make(&bus->plan, map, number, &plan_usual))
		return false;
	bus->ask = calloc((size_t)bus->plan.items + 1, sizeof(*bus->ask));
	bus->sent = calloc((size_t)bus->plan.items + 1, sizeof(*bus->sent));
	bus->request = calloc((size_t)map->net->ask_count + 1, sizeof(*bus->request));
	if (!bus->ask || !bus->sent || !bus->request) {
		bus_close(bus);
		return false;
	}
	for (int i = 0; i < 256; i++) {
		bus->unit[i].id = (uint8_t)i;
		bus->limits[i] = plan_limits_of(&plan_usual, map->net, number, (uint8_t)i);
		bus->unit[i].late_ns = wire.numbered ? 0 : late_ns > UNIT_LATE_NS ? late_ns : UNIT_LATE_NS;
	}
	for (int i = 0; i < bus->plan.asks; i++) {
		bus->has[bus->plan.ask[i].unit] = true;
		bus->ask[i].refresh_ns = INT64_MAX;
	}
	atomic_store(&bus->changed, true);
	return true;
}

void bus_close(struct bus *bus)
{
	plan_free(&bus->plan);
	free(bus->ask);
	free(bus->sent);
	free(bus->request);
	bus->request = NULL;
	bus->ask = NULL;
	bus->sent = NULL;
}

void bus_ask_for(struct bus *bus, int ask, uint32_t number)
{
	field_output(bus->field, bus->map->count + ask, (union iec_value){ .i = number });
	bus_changed(bus);
}

void bus_changed(struct bus *bus)
{
	atomic_store(&bus->changed, true);
}

/* ---- answers ---- */

static void put_bad(struct bus *bus, int from, int to)
{
	const union iec_value none = { .i = 0 };

	pthread_mutex_lock(&bus->field->lock);
	for (int i = from; i < to; i++)
		field_put(bus->field, bus->plan.item[i].point, none, false);
	pthread_mutex_unlock(&bus->field->lock);
	field_wake(bus->field);
}

/* Whether a request is to be made: those that a block asks for only when it does. */
static bool is_waiting(const struct bus *bus, int number)
{
	const int by = bus->plan.ask[number].by;

	return by < 0 || (bus->request[by].number && bus->ask[number].served != bus->request[by].number);
}

static void put_unit_bad(struct bus *bus, uint8_t unit)
{
	for (int i = 0; i < bus->plan.asks; i++)
		if (bus->plan.ask[i].unit == unit && is_waiting(bus, i))
			put_bad(bus, bus->plan.ask[i].from, bus->plan.ask[i].to);
}

/* ---- what a block of the program asks for ---- */

/* Gives the answer when all requests of block @by are done. */
static void answer_block(struct bus *bus, int by)
{
	struct bus_request *request = &bus->request[by];
	const union iec_value value = { .i = (int64_t)((request->number & 0xffff) << 16) | request->status };

	for (int i = 0; i < bus->plan.asks; i++)
		if (bus->plan.ask[i].by == by && is_waiting(bus, i))
			return;
	pthread_mutex_lock(&bus->field->lock);
	field_put(bus->field, bus->map->count + by, value, true);
	pthread_mutex_unlock(&bus->field->lock);
	field_wake(bus->field);
}

/* A request that a block asked for is done, with this status. */
static void serve_block(struct bus *bus, int number, int status)
{
	const int by = bus->plan.ask[number].by;

	if (by < 0)
		return;
	if (!bus->request[by].status)
		bus->request[by].status = status;
	bus->ask[number].served = bus->request[by].number;
	answer_block(bus, by);
}

static void fail_all(struct bus *bus)
{
	for (int i = 0; i < bus->plan.asks; i++)
		if (bus->plan.ask[i].by >= 0 && is_waiting(bus, i))
			serve_block(bus, i, SILENT);
}

/* New requests of blocks. A block that asks does not wait until a silent unit would be asked again, or a
 * broken line opened. */
static void take_requests(struct bus *bus, int64_t now_ns)
{
	pthread_mutex_lock(&bus->field->lock);
	for (int by = 0; by < bus->map->net->ask_count; by++) {
		const uint32_t number = (uint32_t)bus->field->place[bus->map->count + by].output.i;

		if (bus->map->net->ask[by].bus != bus->number || number == bus->request[by].number)
			continue;
		bus->request[by] = (struct bus_request){ .number = number };
		bus->line_ns = number ? now_ns : bus->line_ns;
		for (int i = 0; number && i < bus->plan.asks; i++)
			if (bus->plan.ask[i].by == by) {
				struct unit *unit = &bus->unit[bus->plan.ask[i].unit];

				bus->ask[i].next = 0;
				unit->again_ns = unit->fails && unit->again_ns > now_ns ? now_ns : unit->again_ns;
			}
	}
	pthread_mutex_unlock(&bus->field->lock);
}

static void line_is_gone(struct bus *bus)
{
	bus->line_wait_ns = bus->broken ? bus->line_wait_ns * 2 : LINE_AGAIN_NS;
	if (bus->line_wait_ns > LINE_MOST_NS)
		bus->line_wait_ns = LINE_MOST_NS;
	bus->line_ns = bus->wire.now(bus->wire.context) + bus->line_wait_ns;
	bus->broken = true;
	for (int i = 0; i < bus->plan.asks; i++)
		if (is_waiting(bus, i))
			put_bad(bus, bus->plan.ask[i].from, bus->plan.ask[i].to);
	fail_all(bus);
}

static void count_exception(struct unit *unit, int exception)
{
	unit->counts.exceptions[exception < PDU_EXCEPTIONS ? exception : 0]++;
}

static bool is_alone(const struct bus *bus)
{
	for (int i = 0; i < 256; i++)
		if (bus->has[i] && !unit_is_away(&bus->unit[i]))
			return false;
	return true;
}

/* The first unit that answers again on a bus where none did: it was the cable, so ask the others, too. */
static void wake_others(struct bus *bus, int64_t now_ns)
{
	for (int i = 0; i < 256; i++)
		if (unit_is_away(&bus->unit[i]))
			bus->unit[i].again_ns = now_ns;
}

/* Whether another read of the unit has answers of the same form. */
static bool has_twin(const struct bus *bus, const struct pdu *request, uint8_t unit)
{
	for (int i = 0; i < bus->plan.asks; i++) {
		const struct plan_ask *ask = &bus->plan.ask[i];

		if (ask->unit == unit && !ask->output &&
		    unit_is_twin(request, ask->table, ask->first, ask->count))
			return true;
	}
	return false;
}

/* What one request came to. */
enum result { GOOD, REFUSED, FAILED };

/* Asks once and does the accounts of the unit. @exception: for REFUSED. */
static enum result ask_and_count(struct bus *bus, uint8_t id, const struct pdu *request, struct pdu *answer,
				 int *exception)
{
	struct unit *unit = &bus->unit[id];
	const int64_t sent_ns = bus->wire.now(bus->wire.context);
	enum pdu_fit fit = PDU_WRONG;
	enum heard heard;
	int64_t now_ns;
	bool failed;

	*exception = 0;
	unit->counts.requests++;
	heard = bus->wire.ask(bus->wire.context, id, request, answer, &unit->counts);
	now_ns = bus->wire.now(bus->wire.context);
	if (heard == HEARD_NO_LINE) {
		line_is_gone(bus);
		return FAILED;
	}
	bus->broken = false;
	if (heard == HEARD_ANSWER) {
		fit = pdu_check(request, answer, exception);
		unit->counts.wrong += fit == PDU_WRONG;
	}
	unit->counts.timeouts += heard == HEARD_NOTHING;
	unit->counts.crc += heard == HEARD_CRC;
	if (fit == PDU_EXCEPTION)
		count_exception(unit, *exception);
	/* A device between us and the unit says that the unit does not answer, or it has no time. */
	failed = fit == PDU_WRONG || (fit == PDU_EXCEPTION && (*exception == 5 || *exception == PDU_BUSY ||
		 *exception == PDU_NO_PATH || *exception == PDU_NO_TARGET));
	if (failed) {
		unit_silent(unit, fit == PDU_WRONG ? request : NULL, sent_ns, now_ns);
		if (unit_is_bad(unit))
			put_unit_bad(bus, id);
		return FAILED;
	}
	if (is_alone(bus))
		wake_others(bus, now_ns);
	switch (unit_answered(unit, request, answer, sent_ns, now_ns)) {
	case TRUST_NOTHING:
		return FAILED;
	case TRUST_IT:
		/* Others would wait as long as this one is asked again and again. */
		if (has_twin(bus, request, id))
			unit->again_ns = sent_ns + unit->late_ns;
		break;
	case TRUST_ALL:
		break;
	}
	unit->counts.answers += fit == PDU_FITS;
	return fit == PDU_FITS ? GOOD : REFUSED;
}

static enum result ask_unit(struct bus *bus, uint8_t id, const struct pdu *request, struct pdu *answer,
			    int *exception)
{
	const bool was_broken = bus->broken;
	const enum result result = ask_and_count(bus, id, request, answer, exception);

	pthread_mutex_lock(&bus->field->lock);
	bus->told[id].counts = bus->unit[id].counts;
	for (int i = 0; i < 256; i++)
		if (i == id || bus->broken != was_broken)
			bus->told[i].silent = bus->broken || unit_is_bad(&bus->unit[i]);
	pthread_mutex_unlock(&bus->field->lock);
	return result;
}

struct bus_told bus_tell(struct bus *bus, int id)
{
	struct bus_told told;

	pthread_mutex_lock(&bus->field->lock);
	told = bus->told[id];
	pthread_mutex_unlock(&bus->field->lock);
	return told;
}

/* Whether a smaller request may be allowed where this one is not. */
static bool is_of_address(int exception)
{
	return exception == PDU_NO_ADDRESS || exception == PDU_BAD_VALUE;
}

static bool split(struct bus *bus, int number)
{
	if (!plan_split(&bus->plan, number))
		return false;
	bus->ask[bus->plan.asks - 1] = bus->ask[number];
	return true;
}

/* ---- reads ---- */

static union iec_value value_of(const struct plan_ask *ask, const struct plan_item *item,
				const struct pdu *answer)
{
	const int at = item->channel->reg - ask->first;
	uint16_t word[4];

	if (is_bits(ask->table))
		return (union iec_value){ .i = pdu_bit(answer, at) };
	for (int i = 0; i < item->words; i++)
		word[i] = pdu_at(answer, at + i);
	if (item->bit >= 0)
		return (union iec_value){ .i = word[0] >> item->bit & 1 };
	return pdu_value(item->channel, word);
}

static void take_answer(struct bus *bus, const struct plan_ask *ask, const struct pdu *answer)
{
	pthread_mutex_lock(&bus->field->lock);
	for (int i = ask->from; i < ask->to; i++) {
		const struct plan_item *item = &bus->plan.item[i];

		field_put(bus->field, item->point, value_of(ask, item, answer), true);
	}
	pthread_mutex_unlock(&bus->field->lock);
	field_wake(bus->field);
}

/* @before_ns: when it was asked. */
static void take_read(struct bus *bus, int number, const struct pdu *answer, int64_t before_ns)
{
	const struct plan_ask *ask = &bus->plan.ask[number];
	struct bus_ask *state = &bus->ask[number];
	const int64_t next_ns = state->due_ns + ask->period_ns;

	take_answer(bus, ask, answer);
	/* A request that is too late is left out, not caught up. */
	state->due_ns = next_ns > before_ns ? next_ns : before_ns + (state->due_ns ? 0 : ask->period_ns);
}

static void do_read(struct bus *bus, int number)
{
	const struct plan_ask *ask = &bus->plan.ask[number];
	struct bus_ask *state = &bus->ask[number];
	const int64_t before_ns = bus->wire.now(bus->wire.context);
	struct pdu request, answer;
	int exception;

	pdu_read(&request, ask->table, ask->first, ask->count);
	switch (ask_unit(bus, ask->unit, &request, &answer, &exception)) {
	case FAILED:
		if (unit_is_bad(&bus->unit[ask->unit]) && is_waiting(bus, number))
			serve_block(bus, number, SILENT);
		return;
	case GOOD:
		take_read(bus, number, &answer, before_ns);
		serve_block(bus, number, 0);
		return;
	case REFUSED:
		if (is_of_address(exception) && split(bus, number))
			return;
		put_bad(bus, ask->from, ask->to);
		serve_block(bus, number, exception);
		state->due_ns = before_ns + (ask->period_ns > REFUSED_NS ? ask->period_ns : REFUSED_NS);
	}
}

/* ---- writes ---- */

struct row {
	struct bus *bus;
	int64_t now_ns;
};

static bool is_due(void *context, int item)
{
	const struct row *row = context;
	const struct plan_item *it = &row->bus->plan.item[item];
	const struct bus_sent *sent = &row->bus->sent[item];
	const uint32_t serial = row->bus->field->place[it->point].serial;

	if (it->channel->ask)
		return true;
	return serial && (serial != sent->serial ||
			  (it->channel->refresh_ns && row->now_ns - sent->at_ns >= it->channel->refresh_ns));
}

/* What a write takes along from the field: the values of a row of items, and their serials. */
struct load {
	uint16_t word[PDU_WRITE_WORDS + 4];
	bool bit[PDU_WRITE_BITS];
	uint32_t serial[PDU_WRITE_BITS];
	uint16_t mask;
	int count;
};

static void pack(struct bus *bus, int from, int to, struct load *load)
{
	const int first = bus->plan.item[from].channel->reg;

	load->mask = 0;
	load->word[0] = 0;
	load->count = 0;
	for (int i = from; i < to; i++) {
		const struct plan_item *item = &bus->plan.item[i];
		const struct field_place *place = &bus->field->place[item->point];
		const int at = item->channel->reg - first;

		load->serial[i - from] = place->serial;
		load->count = at + item->words;
		if (is_bits(item->channel->table)) {
			load->bit[at] = place->output.i != 0;
		} else if (item->bit < 0) {
			pdu_words(item->channel, place->output, load->word + at);
		} else if (place->serial) {
			load->mask |= (uint16_t)(1 << item->bit);
			load->word[0] |= (uint16_t)((place->output.i != 0) << item->bit);
		}
	}
}

/* Bits of a register, for units without function 22: read it and write it. */
static enum result write_bits_whole(struct bus *bus, uint8_t unit, uint16_t reg, const struct load *load,
				    int *exception)
{
	struct pdu request, answer;
	enum result result;
	uint16_t word;

	pdu_read(&request, TABLE_HOLDING_REGISTER, reg, 1);
	result = ask_unit(bus, unit, &request, &answer, exception);
	if (result != GOOD)
		return result;
	word = (uint16_t)((pdu_at(&answer, 0) & ~load->mask) | load->word[0]);
	pdu_set_words(&request, reg, &word, 1, bus->unit[unit].no_single);
	return ask_unit(bus, unit, &request, &answer, exception);
}

static enum result write_row(struct bus *bus, const struct plan_ask *ask, const struct plan_item *first,
			     const struct load *load, int *exception)
{
	struct unit *unit = &bus->unit[ask->unit];
	const uint16_t reg = first->channel->reg;
	struct pdu request, answer;
	enum result result;

	if (first->bit >= 0 && unit->no_mask)
		return write_bits_whole(bus, ask->unit, reg, load, exception);
	if (first->bit >= 0)
		pdu_mask(&request, reg, load->mask, load->word[0]);
	else if (is_bits(ask->table))
		pdu_set_bits(&request, reg, load->bit, load->count, unit->no_single);
	else
		pdu_set_words(&request, reg, load->word, load->count, unit->no_single);
	result = ask_unit(bus, ask->unit, &request, &answer, exception);
	if (result != REFUSED || *exception != PDU_NO_FUNCTION)
		return result;
	/* It does not have this function: another one may do. */
	switch (request.byte[0]) {
	case PDU_MASK:
		unit->no_mask = true;
		return write_bits_whole(bus, ask->unit, reg, load, exception);
	case PDU_SET_COIL:
	case PDU_SET_REGISTER:
		unit->no_single = true;
		return FAILED;
	default:
		unit->no_many = !unit->no_single;
		return unit->no_many ? FAILED : REFUSED;
	}
}

/* When the request is due again. */
static void plan_writes(struct bus *bus, int number)
{
	const struct plan_ask *ask = &bus->plan.ask[number];
	struct row row = { .bus = bus, .now_ns = bus->wire.now(bus->wire.context) };
	const bool waits = bus->ask[number].changed;
	int64_t next_ns = INT64_MAX;

	if (ask->by >= 0)
		return;
	pthread_mutex_lock(&bus->field->lock);
	bus->ask[number].changed = false;
	for (int i = ask->from; i < ask->to; i++) {
		const int64_t refresh_ns = bus->plan.item[i].channel->refresh_ns;
		const int64_t at_ns = bus->sent[i].at_ns + refresh_ns;

		if (is_due(&row, i))
			bus->ask[number].changed = true;
		else if (bus->sent[i].serial && refresh_ns && at_ns < next_ns)
			next_ns = at_ns;
	}
	bus->ask[number].refresh_ns = next_ns;
	if (!waits)
		bus->ask[number].since_ns = row.now_ns;
	pthread_mutex_unlock(&bus->field->lock);
}

/* Also what is refused counts as written: it is tried again at the next change or refresh. */
static void take_written(struct bus *bus, int from, int to, const struct load *load, int64_t now_ns,
			 bool good)
{
	pthread_mutex_lock(&bus->field->lock);
	for (int i = from; i < to; i++) {
		bus->sent[i] = (struct bus_sent){ load->serial[i - from], now_ns };
		field_put(bus->field, bus->plan.item[i].point, bus->field->place[bus->plan.item[i].point].output,
			  good);
	}
	pthread_mutex_unlock(&bus->field->lock);
	field_wake(bus->field);
}

/* Whether a write may take a read along. */
static bool may_go_together(const struct bus *bus, int number)
{
	const struct plan_ask *ask = &bus->plan.ask[number];

	return ask->output && ask->by < 0 && ask->table == TABLE_HOLDING_REGISTER && bus->plan.item[ask->from].bit < 0 &&
	       bus->limits[ask->unit].together && !bus->unit[ask->unit].no_both && !bus->ask[number].apart;
}

/* The write of registers that takes the read @number along; -1: none is due. */
static int write_with(const struct bus *bus, int number)
{
	const struct plan_ask *read = &bus->plan.ask[number];

	for (int i = 0; i < bus->plan.asks && read->table == TABLE_HOLDING_REGISTER && read->by < 0; i++)
		if (bus->plan.ask[i].unit == read->unit && bus->ask[i].changed && may_go_together(bus, i))
			return i;
	return -1;
}

/* The read of registers of the unit that is due for longest, or in a quarter of its period; -1: none. */
static int read_with(const struct bus *bus, uint8_t unit, int64_t now_ns)
{
	int64_t best_ns = INT64_MAX;
	int best = -1;

	for (int i = 0; i < bus->plan.asks; i++) {
		const struct plan_ask *ask = &bus->plan.ask[i];
		int64_t due_ns;

		if (ask->unit != unit || ask->output || ask->by >= 0 || ask->table != TABLE_HOLDING_REGISTER)
			continue;
		due_ns = bus->ask[i].due_ns;
		if (due_ns - ask->period_ns / 4 <= now_ns && due_ns < best_ns) {
			best = i;
			best_ns = due_ns;
		}
	}
	return best;
}

/* Writes registers, and reads others in the same request (function 23). False: that is not how they are written. */
static bool write_together(struct bus *bus, int number, const struct plan_item *first,
			   const struct load *load, int64_t now_ns, enum result *result)
{
	const struct plan_ask *ask = &bus->plan.ask[number];
	struct unit *unit = &bus->unit[ask->unit];
	const bool may = may_go_together(bus, number) && load->count <= PDU_BOTH_WORDS;
	const int read = may ? read_with(bus, ask->unit, now_ns) : -1;
	struct pdu request, answer;
	int exception;

	if (read < 0)
		return false;
	pdu_both(&request, bus->plan.ask[read].first, bus->plan.ask[read].count, first->channel->reg,
		 load->word, load->count);
	*result = ask_unit(bus, ask->unit, &request, &answer, &exception);
	if (*result == GOOD)
		take_read(bus, read, &answer, now_ns);
	/* Which of the two it refuses is not known: each is asked by itself from now on. */
	unit->no_both |= *result == REFUSED && exception == PDU_NO_FUNCTION;
	bus->ask[number].apart |= *result == REFUSED;
	return *result != REFUSED;
}

static void do_write(struct bus *bus, int number)
{
	static _Thread_local struct load load;
	const struct plan_ask ask = bus->plan.ask[number];
	struct row row = { .bus = bus, .now_ns = bus->wire.now(bus->wire.context) };
	int from = ask.from + bus->ask[number].next, to, exception;
	enum result result;

	pthread_mutex_lock(&bus->field->lock);
	to = plan_run(&bus->plan, &ask, &from, is_due, &row, &bus->limits[ask.unit]);
	/* What was written last comes last: an item that is due all the time holds up no other. */
	if (to <= from && ask.by < 0) {
		from = ask.from;
		to = plan_run(&bus->plan, &ask, &from, is_due, &row, &bus->limits[ask.unit]);
	}
	/* One at a time for a unit that takes no more. */
	if (bus->unit[ask.unit].no_many && to > from && bus->plan.item[from].bit < 0 &&
	    bus->plan.item[from].words == 1)
		to = from + 1;
	if (to > from)
		pack(bus, from, to, &load);
	pthread_mutex_unlock(&bus->field->lock);
	if (to > from) {
		exception = 0;
		if (!write_together(bus, number, &bus->plan.item[from], &load, row.now_ns, &result))
			result = write_row(bus, &ask, &bus->plan.item[from], &load, &exception);
		if (result == REFUSED && is_of_address(exception) && split(bus, number))
			return;
		if (result == FAILED) {
			if (unit_is_bad(&bus->unit[ask.unit]) && ask.by >= 0 && is_waiting(bus, number))
				serve_block(bus, number, SILENT);
			return;
		}
		take_written(bus, from, to, &load, row.now_ns, result == GOOD);
		bus->ask[number].next = to - ask.from;
		if (result == REFUSED || to == ask.to)
			serve_block(bus, number, result == REFUSED ? exception : 0);
	}
	bus->ask[number].changed = false;
	plan_writes(bus, number);
}

/* ---- the next request ---- */

static int64_t due_of(const struct bus *bus, int number, int64_t now_ns, bool alone)
{
	const struct plan_ask *ask = &bus->plan.ask[number];
	const struct bus_ask *state = &bus->ask[number];
	const int64_t own = ask->by >= 0 ? (is_waiting(bus, number) ? now_ns : INT64_MAX) :
			    !ask->output ? state->due_ns : state->changed ? state->since_ns : state->refresh_ns;
	const struct unit *unit = &bus->unit[ask->unit];
	const int64_t unit_ns = unit_due_ns(unit, alone);
	int64_t due_ns = own > unit_ns ? own : unit_ns, clear_ns;

	if (ask->output || !unit->late_ns || due_ns > now_ns)
		return due_ns;
	clear_ns = unit_clear_ns(unit, ask->table, ask->first, ask->count);
	return clear_ns > due_ns ? clear_ns : due_ns;
}

struct choice {
	int read, write, probe; /* numbers of requests that are due; -1: none     */
	int live;              /* requests of units that answer                */
	int64_t next_ns;       /* when something else is due                    */
};

/* The longest due of each kind. */
static struct choice choose(const struct bus *bus, int64_t now_ns)
{
	struct choice choice = { .read = -1, .write = -1, .probe = -1, .next_ns = INT64_MAX };
	const bool alone = is_alone(bus);
	int64_t read_ns = INT64_MAX, write_ns = INT64_MAX, probe_ns = INT64_MAX;

	for (int i = 0; i < bus->plan.asks; i++) {
		const struct plan_ask *ask = &bus->plan.ask[i];
		const bool away = unit_is_away(&bus->unit[ask->unit]);
		const int64_t due_ns = due_of(bus, i, now_ns, alone);
		int64_t *best_ns = away ? &probe_ns : ask->output ? &write_ns : &read_ns;
		int *best = away ? &choice.probe : ask->output ? &choice.write : &choice.read;

		choice.live += !away && !ask->output && ask->by < 0;
		if (due_ns > now_ns) {
			if (due_ns < choice.next_ns)
				choice.next_ns = due_ns;
		} else if (due_ns < *best_ns) {
			*best = i;
			*best_ns = due_ns;
		}
	}
	return choice;
}

int64_t bus_step(struct bus *bus)
{
	const int64_t now_ns = bus->wire.now(bus->wire.context);
	struct choice choice;
	int next;

	if (atomic_load(&bus->changed))
		take_requests(bus, now_ns);
	if (bus->broken && now_ns < bus->line_ns)
		return bus->line_ns;
	if (atomic_exchange(&bus->changed, false))
		for (int i = 0; i < bus->plan.asks; i++)
			if (bus->plan.ask[i].output)
				plan_writes(bus, i);
	choice = choose(bus, now_ns);
	/* A read follows a write, and neither waits long for the other. */
	next = choice.read < 0 || (choice.write >= 0 && !bus->wrote) ? choice.write : choice.read;
	if (choice.probe >= 0 && (next < 0 || bus->since_probe >= choice.live)) {
		next = choice.probe;
		bus->since_probe = -1;
	}
	if (next < 0)
		return choice.next_ns;
	bus->since_probe++;
	bus->wrote = bus->plan.ask[next].output;
	if (!bus->wrote && write_with(bus, next) >= 0)
		next = write_with(bus, next);
	if (bus->plan.ask[next].output)
		do_write(bus, next);
	else
		do_read(bus, next);
	return now_ns;
}
