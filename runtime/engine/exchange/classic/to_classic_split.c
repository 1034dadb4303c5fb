/* SPDX-License-Identifier: MIT
 *
 * to_classic_split - a rung that does not fit the grid of ClassicLadder, or would be evaluated
 * in another order there, as several rungs with bits between them.
 *
 * A rung computes the power of a net as a bit, with a row for each way that leads to it.
 */
#include "engine/exchange/classic/to_classic_parts.h"

#include <string.h>

enum { CHAIN = 16 };

/* struct out_part is large: not inlined, frames stay under 1 KB. */
#define APART __attribute__((noinline))

/* Contacts in series, from the rail on. */
struct way { struct out_part item[CHAIN]; int count, width; bool never; };

static inline struct out_part contact(int code, struct classic_variable variable)
{
	return (struct out_part){ .code = code, .width = 1, .height = 1,
				  .variable = variable };
}

static inline struct out_part coil(int code, int bit)
{
	return contact(code, variable_of(CL_BIT, bit));
}

/* When a net has power: always, never, or while a bit is TRUE. */
struct net_power { bool known, always, never; struct classic_variable bit; };

struct splitting {
	struct leaving *e;
	struct out_rung *r;
	struct net_power *net;
	struct net_power *given;   /* by item: power behind it, if computed       */
	bool *done;
	struct classic_variable gate[4]; /* inputs of a counter instead of their nets */
};

static int longest(const struct splitting *s)
{
	return s->e->columns - 3;
}

static int only_feeder(const struct splitting *s, int net)
{
	const struct network *n = &s->r->network;

	if (net == NET_RAIL || s->net[net].known || n->reader_count[net] != 1 ||
	    n->first_feeder[net + 1] != n->first_feeder[net] + 1)
		return -1;
	return n->feeder[n->first_feeder[net]];
}

static bool is_simple(const struct splitting *s, int index)
{
	const struct out_part *item = &s->r->item[index];

	return !s->given[index].known && !item->invert && !item->before &&
	       ((item->code >= CL_NO && item->code <= CL_WIRE) || item->code == CL_COMPARE);
}

/* Adds an element in series. */
static APART void way_add(struct way *way, struct out_part item)
{
	if (way->count == CHAIN)
		return;
	way->item[way->count++] = item;
	way->width += item.width;
}

static APART void way_contact(struct way *way, int code, struct classic_variable variable)
{
	way_add(way, contact(code, variable));
}

static bool power_contact(struct splitting *s, int net, struct out_part *out, bool *never);

/* The way through one feeder, back to the rail or to a bit. */
static APART void find_way(struct splitting *s, int index, struct way *way)
{
	int chain[CHAIN], count = 0, width = 1, in, back = index;
	struct out_part first;
	const struct net_power *given = &s->given[index];

	memset(way, 0, sizeof(*way));
	if (given->known) {
		way->never = given->never;
		if (!given->always && !given->never)
			way_contact(way, CL_NO, given->bit);
		return;
	}
	for (;;) {
		chain[count++] = back;
		width += s->r->item[back].width;
		in = s->r->item[back].in;
		if (s->r->boxes || count == CHAIN - 1)
			break;
		back = only_feeder(s, in);
		if (back < 0 || !is_simple(s, back) || s->r->item[back].dead ||
		    width + s->r->item[back].width > longest(s))
			break;
	}
	if (power_contact(s, in, &first, &way->never))
		way_add(way, first);
	while (count-- > 0) {
		struct out_part item = s->r->item[chain[count]];

		item.height = 1;
		if (item.code != CL_WIRE)
			way_add(way, item);
	}
}

/* A coil passes power on: the way to it. */
static APART void way_to(struct splitting *s, int net, struct way *way)
{
	struct out_part first;

	memset(way, 0, sizeof(*way));
	if (power_contact(s, net, &first, &way->never))
		way_add(way, first);
}

static void copy_way(struct way *to, const struct way *from)
{
	memcpy(to, from, sizeof(*to));
}

/* In row @y, with wires up to column @to. Returns the next column. */
static int draw_way(struct leaving *e, struct classic_rung *rung, int y,
		    const struct way *way, int to)
{
	int x = 0;

	if (way->never)
		x = 1;
	for (int i = 0; i < way->count && !way->never; i++) {
		out_put(e, rung, y, x, &way->item[i]);
		x += way->item[i].width;
	}
	for (; x < to; x++)
		rung->cell[y][x].element = CL_WIRE;
	return x;
}

/* A rung of parallel ways and an output. */
static void draw_ways(struct leaving *e, const struct way *way, int ways,
		      const struct out_part *output)
{
	struct classic_rung *rung = rung_begin(e);
	int join = 1, end = e->columns - output->width;

	if (!rung)
		return;
	for (int i = 0; i < ways; i++)
		if (way[i].width > join)
			join = way[i].width;
	for (int i = 0; i < ways; i++) {
		draw_way(e, rung, i, &way[i], i ? join : end);
		rung->cell[i][join].top = i > 0;
	}
	out_put(e, rung, 0, end, output);
	if (output->code == CL_JUMP)
		note_jump(e, &rung->cell[0][end], output);
}

/* All ways of a net. If a rung has too few rows, a rung before it joins some into a bit. */
static int find_ways(struct splitting *s, int net, struct way *way)
{
	const struct network *n = &s->r->network;
	int count = 0;

	for (int i = n->first_feeder[net]; i < n->first_feeder[net + 1]; i++) {
		const struct out_part *item = &s->r->item[n->feeder[i]];
		struct way *next = arena_alloc(s->e->arena, sizeof(*next));

		if (!next || item->dead)
			continue;
		if (item->actor)
			way_to(s, item->in, next);
		else
			find_way(s, n->feeder[i], next);
		if (next->never)
			continue;
		if (count == s->e->rows) {
			int bit = spare_bit(s->e);
			struct out_part output = coil(CL_COIL, bit);

			draw_ways(s->e, way, count, &output);
			memset(way, 0, sizeof(*way));
			way_contact(way, CL_NO, output.variable);
			count = 1;
		}
		copy_way(&way[count++], next);
	}
	return count;
}

static struct way *ways_room(struct splitting *s)
{
	return arena_alloc(s->e->arena, sizeof(struct way) * CLASSIC_ROWS);
}

/* ---- blocks ---- */

static void give(struct splitting *s, int index, int bit)
{
	s->given[index] = (struct net_power){ .known = true,
					      .bit = variable_of(CL_BIT, bit) };
}

/* A rung of a block: a contact at each input; a coil stores its first output. */
static APART void draw_block(struct splitting *s, int index)
{
	const struct out_part *item = &s->r->item[index];
	struct out_part *input = arena_alloc(s->e->arena, 4 * sizeof(*input)), output;
	struct classic_rung *rung;
	bool has[4] = { false }, always[4] = { false }, never;
	bool read = item->out != NET_RAIL && s->r->network.reader_count[item->out];
	int bit = read ? spare_bit(s->e) : 0;

	if (!input)
		return;
	for (int i = 0; i < item->height && i < 4; i++) {
		if (item->given[i].type >= 0) {
			has[i] = true;
			input[i] = contact(item->inverse[i] ? CL_NC : CL_NO, item->given[i]);
		} else if (item->pin[i] != NET_NONE) {
			has[i] = power_contact(s, item->pin[i], &input[i], &never);
			always[i] = !has[i] && !never;
		}
		if (s->gate[i].type >= 0) {
			has[i] = true;
			input[i] = contact(CL_NO, s->gate[i]);
		}
	}
	rung = rung_begin(s->e);
	if (!rung)
		return;
	for (int i = 0; i < item->height && i < 4; i++) {
		if (has[i])
			out_put(s->e, rung, i, 0, &input[i]);
		else if (always[i])
			rung->cell[i][0].element = CL_WIRE;
	}
	out_put(s->e, rung, 0, 1, item);
	if (!read)
		return;
	for (int x = 3; x < s->e->columns - 1; x++)
		rung->cell[0][x].element = CL_WIRE;
	output = coil(CL_COIL, bit);
	out_put(s->e, rung, 0, s->e->columns - 1, &output);
	give(s, index, bit);
}

/* A rung for each word or bit of the list. */
static void draw_before(struct leaving *e, const struct out_before *before)
{
	for (; before && e->good; before = before->next) {
		struct out_part item = { .code = CL_OPERATE, .width = 3, .height = 1,
					 .text = before->text };
		struct way *way = arena_alloc(e->arena, sizeof(*way));

		if (!way)
			return;
		if (before->bit >= 0) {
			item.code = CL_COMPARE;
			way_add(way, item);
			item = coil(CL_COIL, before->bit);
		}
		draw_ways(e, way, 1, &item);
	}
}

static void compare_bit(struct leaving *e, const char *text, int bit)
{
	const struct out_before one = { text, bit, NULL };

	draw_before(e, &one);
}

void draw_step(struct leaving *e, int code, struct classic_variable variable,
	       const struct out_part *output)
{
	struct way *way = arena_alloc(e->arena, sizeof(*way));

	if (!way)
		return;
	if (code != CL_WIRE)
		way_contact(way, code, variable);
	draw_ways(e, way, 1, output);
}

/* The bit with the power of a net. */
static struct classic_variable net_bit(struct splitting *s, int net, bool *never)
{
	struct out_part first, output;

	if (power_contact(s, net, &first, never))
		return first.variable;
	output = coil(CL_COIL, *never ? never_bit(s->e) : spare_bit(s->e));
	if (!*never)
		draw_step(s->e, CL_WIRE, variable_of(0, 0), &output);
	return output.variable;
}

/* %C counts round from 9999 to 0. A gate stops edges of an input at the limit. */
static APART void gate(struct splitting *s, int row, const struct out_part *item,
		 const char *limit)
{
	bool never = false;
	int pulse, allowed = spare_bit(s->e);
	struct classic_variable bit;
	struct out_part output;
	struct way *way = arena_alloc(s->e->arena, sizeof(*way));

	if (!way || (item->pin[row] == NET_NONE && item->given[row].type < 0))
		return;
	bit = item->given[row].type >= 0 ? item->given[row] :
	      net_bit(s, item->pin[row], &never);
	pulse = spare_bit(s->e);
	output = coil(CL_COIL, pulse);
	draw_step(s->e, item->given[row].type >= 0 && item->inverse[row] ? CL_FALLING :
		  CL_RISING, bit, &output);
	compare_bit(s->e, out_text(s->e, "@251/%d@%s", item->slot->number, limit), allowed);
	way_contact(way, CL_NO, output.variable);
	way_contact(way, CL_NO, variable_of(CL_BIT, allowed));
	output = coil(CL_COIL, spare_bit(s->e));
	draw_ways(s->e, way, 1, &output);
	s->gate[row] = output.variable;
}

static APART void draw_counter(struct splitting *s, int index)
{
	const struct out_part *item = &s->r->item[index];
	struct out_slot *slot = slot_find(s->e, item->slot->var);
	int number = slot->number, up = -1;

	gate(s, 2, item, "<9999");
	gate(s, 3, item, ">0");
	draw_block(s, index);
	if (item->word != FB_CTD) {
		up = extra_bit(s->e, slot, 0);
		compare_bit(s->e, out_text(s->e, "@251/%d@>=@250/%d@", number, number), up);
	}
	if (item->word != FB_CTU) {
		int down = extra_bit(s->e, slot, item->word == FB_CTUD);

		compare_bit(s->e, out_text(s->e, "@251/%d@<=0", number), down);
		up = up < 0 ? down : up;
	}
	give(s, index, up);
}

static struct classic_variable input_bit(struct splitting *s, const struct out_part *item,
					 int row)
{
	struct out_part output;
	bool never;

	if (item->given[row].type < 0)
		return item->pin[row] == NET_NONE ?
		       variable_of(CL_BIT, never_bit(s->e)) :
		       net_bit(s, item->pin[row], &never);
	if (!item->inverse[row])
		return item->given[row];
	output = coil(CL_COIL, spare_bit(s->e));
	draw_step(s->e, CL_NC, item->given[row], &output);
	return output.variable;
}

/* R_TRIG, F_TRIG, SR and RS: rungs and a bit. */
static APART void draw_bits(struct splitting *s, int index)
{
	const struct out_part *item = &s->r->item[index];
	struct out_slot *slot = slot_find(s->e, item->slot->var);
	int bit = extra_bit(s->e, slot, 0);
	struct classic_variable a = input_bit(s, item, 0), b;
	struct out_part output = coil(CL_COIL, bit);
	struct way *way = ways_room(s);

	if (!way)
		return;
	out_mark(s->e, item);
	if (item->word == FB_R_TRIG || item->word == FB_F_TRIG) {
		draw_step(s->e, item->word == FB_R_TRIG ? CL_RISING : CL_FALLING, a,
			  &output);
	} else {
		b = input_bit(s, item, 1);
		way_contact(&way[0], CL_NO, a);
		if (item->word == FB_RS)
			way_contact(&way[0], CL_NC, b);
		way_contact(&way[1], CL_NO, output.variable);
		way_contact(&way[1], CL_NC, b);
		draw_ways(s->e, way, 2, &output);
	}
	give(s, index, bit);
}

/* An assignment or call in the middle of a rung: power goes on behind it. */
static APART void draw_middle(struct splitting *s, int index)
{
	const struct out_part *item = &s->r->item[index];
	struct out_part first;
	bool never, has = power_contact(s, item->in, &first, &never);

	s->given[index] = (struct net_power){ .known = true, .always = !has && !never,
		.never = never, .bit = has ? first.variable : variable_of(0, 0) };
	if (!never)
		draw_step(s->e, has ? CL_NO : CL_WIRE,
			  has ? first.variable : variable_of(0, 0), item);
}

static APART void draw_inverted(struct splitting *s, int index)
{
	bool never;
	struct classic_variable bit = net_bit(s, s->r->item[index].in, &never);
	struct out_part output = coil(CL_COIL, spare_bit(s->e));

	out_mark(s->e, &s->r->item[index]);
	draw_step(s->e, CL_NC, bit, &output);
	give(s, index, output.variable.number);
}

/* Does an element of the rung write what @item reads? Then it is read in its turn. */
static bool is_changed(const struct splitting *s, const struct out_part *item)
{
	for (int i = 0; i < s->r->count; i++) {
		const struct out_part *box = &s->r->item[i];
		bool writes = is_block(box) || box->code == CL_PART ||
			      (!box->actor && (box->code == CL_OPERATE ||
					       box->code == CL_CALL));

		if (writes && part_touches(item, box))
			return true;
	}
	return item->before != NULL;
}

static APART void draw_read(struct splitting *s, int index)
{
	const struct out_part *item = &s->r->item[index];
	struct out_part output;
	struct way *way = arena_alloc(s->e->arena, sizeof(*way));

	draw_before(s->e, item->before);
	if (!way)
		return;
	find_way(s, index, way);
	if (way->never) {
		s->given[index] = (struct net_power){ .known = true, .never = true };
		return;
	}
	output = coil(CL_COIL, spare_bit(s->e));
	draw_ways(s->e, way, 1, &output);
	give(s, index, output.variable.number);
}

static void settle(struct splitting *s, int net);

static void work_out(struct splitting *s, int index)
{
	const struct out_part *item = &s->r->item[index];

	if (s->done[index] || item->actor || !s->e->good)
		return;
	s->done[index] = true;
	if (item->dead) { /* elements before it are evaluated all the same */
		settle(s, item->in);
		return;
	}
	s->e->row = item->row + 1;
	s->e->col = item->col + 1;
	if (item->in != NET_RAIL)
		settle(s, item->in);
	for (int i = 0; i < 4; i++) {
		s->gate[i] = variable_of(-1, 0);
		if (item->pin[i] != NET_NONE)
			settle(s, item->pin[i]);
	}
	for (int i = 0; i < 4; i++)
		s->gate[i] = variable_of(-1, 0);
	if (item->invert) {
		draw_inverted(s, index);
		return;
	}
	if (item->code == CL_WIRE)
		return;
	if (is_block(item) || item->code == CL_PART || item->code == CL_OPERATE ||
	    item->code == CL_CALL)
		draw_before(s->e, item->before);
	if (item->code == CL_PART)
		draw_bits(s, index);
	else if (item->code == CL_COUNT && item->word != FB_CL_COUNTER)
		draw_counter(s, index);
	else if (is_block(item))
		draw_block(s, index);
	else if (item->code == CL_OPERATE || item->code == CL_CALL)
		draw_middle(s, index);
	else if (is_changed(s, item))
		draw_read(s, index);
	draw_before(s->e, item->after);
}

static void settle(struct splitting *s, int net)
{
	const struct network *n = &s->r->network;
	struct net_power *power = &s->net[net];
	struct way *way;
	struct out_part output;
	int count;

	if (net == NET_RAIL || power->known)
		return;
	power->known = true;
	for (int i = n->first_feeder[net]; s->r->boxes && i < n->first_feeder[net + 1]; i++)
		work_out(s, n->feeder[i]);
	for (int i = n->first_feeder[net]; i < n->first_feeder[net + 1]; i++)
		if (s->r->item[n->feeder[i]].invert)
			work_out(s, n->feeder[i]);
	way = ways_room(s);
	count = way ? find_ways(s, net, way) : 0;
	power->never = count == 0;
	for (int i = 0; i < count; i++)
		power->always |= way[i].count == 0;
	if (power->never || power->always)
		return;
	if (count == 1 && way[0].count == 1 && way[0].item[0].code == CL_NO &&
	    s->given[n->feeder[n->first_feeder[net]]].known) {
		power->bit = way[0].item[0].variable;
		return;
	}
	power->bit = variable_of(CL_BIT, spare_bit(s->e));
	output = contact(CL_COIL, power->bit);
	draw_ways(s->e, way, count, &output);
}

/* ---- ways ---- */

static bool power_contact(struct splitting *s, int net, struct out_part *out, bool *never)
{
	struct net_power *power;

	*never = false;
	if (net == NET_RAIL)
		return false;
	settle(s, net);
	power = &s->net[net];
	*never = power->never;
	*out = contact(CL_NO, power->bit);
	return !power->always && !power->never;
}

/* ---- outputs ---- */

/* A coil also writes without power. */
static bool acts_always(const struct out_part *item)
{
	return item->code == CL_COIL || item->code == CL_COIL_NOT;
}

struct acting { struct way *way; struct out_part *output; int count; };

static APART void flush(struct splitting *s, struct acting *acting)
{
	struct classic_rung *rung;

	if (!acting->count)
		return;
	rung = rung_begin(s->e);
	for (int i = 0; rung && i < acting->count; i++) {
		const struct out_part *output = &acting->output[i];
		int end = s->e->columns - output->width;

		draw_way(s->e, rung, i, &acting->way[i], end);
		out_put(s->e, rung, i, end, output);
		if (output->code == CL_JUMP) {
			s->e->row = output->row + 1;
			s->e->col = output->col + 1;
			note_jump(s->e, &rung->cell[i][end], output);
		}
	}
	acting->count = 0;
}

static APART void act(struct splitting *s, const struct out_part *item, struct acting *acting)
{
	struct out_part first;
	struct way *way;
	bool never, has;

	if (item->before || item->edge)
		flush(s, acting);
	draw_before(s->e, item->before);
	if (item->edge) {
		first = contact(item->edge, net_bit(s, item->in, &never));
		has = true;
		never = false;
	} else {
		has = power_contact(s, item->in, &first, &never);
	}
	if (never && !acts_always(item))
		return;
	way = &acting->way[acting->count];
	memset(way, 0, sizeof(*way));
	way->never = never;
	if (has)
		way_add(way, first);
	acting->output[acting->count++] = *item;
	if (acting->count == s->e->rows)
		flush(s, acting);
}

/* A rung with one output whose ways fit into one rung needs no bits. */
static APART bool act_alone(struct splitting *s, int index)
{
	const struct out_part *item = &s->r->item[index];
	const struct network *n = &s->r->network;
	struct way *way = ways_room(s);
	int count;

	if (!way || item->before || item->edge || item->in == NET_RAIL ||
	    s->net[item->in].known)
		return false;
	for (int i = n->first_feeder[item->in]; i < n->first_feeder[item->in + 1]; i++)
		if (s->r->item[n->feeder[i]].invert)
			work_out(s, n->feeder[i]);
	count = find_ways(s, item->in, way);
	if (!count && !acts_always(item))
		return true;
	if (!count)
		way[count++].never = true;
	for (int i = 0; i < count; i++)
		if (!way[i].count && !way[i].never) {
			copy_way(&way[0], &way[i]);
			count = 1;
		}
	draw_ways(s->e, way, count, item);
	return true;
}

void split_rung(struct leaving *e, struct out_rung *r)
{
	struct splitting *s = arena_alloc(e->arena, sizeof(*s));
	struct acting acting = { ways_room(&(struct splitting){ .e = e }), NULL, 0 };
	int actors = 0, last = 0;

	acting.output = arena_alloc(e->arena, sizeof(*acting.output) * CLASSIC_ROWS);
	if (!s || !acting.way || !acting.output)
		return;
	s->e = e;
	s->r = r;
	s->net = arena_alloc(e->arena, sizeof(*s->net) * ((size_t)r->network.net_count + 1));
	s->given = arena_alloc(e->arena, sizeof(*s->given) * ((size_t)r->count + 1));
	s->done = arena_alloc(e->arena, (size_t)r->count + 1);
	if (!s->net || !s->given || !s->done)
		return;
	for (int i = 0; i < r->count; i++) {
		if (r->item[i].actor)
			last = i, actors++;
		/* In order of evaluation: what feeds an output; the outputs act at the end. */
		if (r->boxes && r->item[i].output && r->item[i].actor &&
		    r->item[i].in != NET_RAIL)
			settle(s, r->item[i].in);
		else if (r->boxes && r->item[i].output)
			work_out(s, i);
	}
	if (actors == 1 && !r->boxes && act_alone(s, last))
		return;
	for (int i = 0; i < r->count && e->good; i++)
		if (r->item[i].actor && r->item[i].in != NET_RAIL)
			settle(s, r->item[i].in);
	for (int i = 0; i < r->count && e->good; i++)
		if (r->item[i].actor)
			act(s, &r->item[i], &acting);
	flush(s, &acting);
}
