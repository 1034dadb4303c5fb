/* SPDX-License-Identifier: MIT
 *
 * ldmicro_names - variables of an LDmicro program, their types, and the blocks of its own.
 *
 * LDmicro makes a variable at its first use, and a name tells what it is: X an input, Y an output,
 * A an analog input, P an output of pulses; T and C count.
 */
#include "engine/exchange/ldmicro/ldmicro_parts.h"

#include <stdlib.h>
#include <string.h>

enum { AREA_BYTES = 128 }; /* of inputs, and of outputs, without an AREA          */

const char *type_of(int bytes)
{
	return bytes == 1 ? "SINT" : bytes == 2 ? "INT" : "DINT";
}

void name_add(struct ldmicro_conversion *c, struct name_list *list, const char *name)
{
	const char **one = arena_push(c->w.arena, &list->name, &list->count, sizeof(*one));

	if (one)
		*one = name;
}

/* ---- variables ---- */

static const struct ldmicro_io *pin_of(const struct ldmicro_conversion *c, const char *name)
{
	for (int i = 0; i < c->program->ios; i++)
		if (!strcmp(c->program->io[i].name, name))
			return &c->program->io[i];
	return NULL;
}

static void give_address(struct ldmicro_conversion *c, struct ldmicro_var *var)
{
	const struct ldmicro_io *io = pin_of(c, var->name);

	if (var->bit && strchr("XI", var->name[0]) && c->inputs < 8 * AREA_BYTES) {
		var->at = w_text(&c->w, "%%IX%d.%d", c->inputs / 8, c->inputs % 8);
		c->inputs++;
	} else if (var->bit && strchr("YM", var->name[0]) && c->outputs < 8 * AREA_BYTES) {
		var->at = w_text(&c->w, "%%QX%d.%d", c->outputs / 8, c->outputs % 8);
		c->outputs++;
	}
	if (io && io->pin > 0)
		var->comment = w_text(&c->w, "pin %d", io->pin);
}

/* Words lie behind the bits. NULL: there is no room. */
const char *word_address(struct ldmicro_conversion *c, bool output)
{
	int *words = output ? &c->words_out : &c->words_in;
	const int bits = output ? c->outputs : c->inputs;
	const int at = 2 * ((bits + 15) / 16 + *words);

	if (at > AREA_BYTES - 2)
		return NULL;
	++*words;
	return w_text(&c->w, output ? "%%QW%d" : "%%IW%d", at);
}

static struct ldmicro_var *var_new(struct ldmicro_conversion *c, const char *name, bool bit)
{
	struct ldmicro_var **slot, *var = arena_alloc(c->w.arena, sizeof(*var));

	if (!var)
		return NULL;
	*var = (struct ldmicro_var){ .name = name, .bit = bit, .bytes = 2,
				     .line = c->w.at.line };
	var->ours = w_name(&c->w, name);
	if (strcmp(var->ours, name) != 0)
		w_tell(&c->w, REPORT_CHANGED, "\"%s\" is called %s here", name, var->ours);
	if (name[0] == '#')
		w_tell(&c->w, REPORT_LOST, "%s is a register of the microcontroller; here it is a variable",
		       name);
	slot = arena_push(c->w.arena, &c->var, &c->vars, sizeof(*slot));
	if (!slot)
		return NULL;
	*slot = var;
	give_address(c, var);
	return var;
}

/* There is no memory, which the arena remembers. */
static struct ldmicro_var *no_var(struct ldmicro_conversion *c)
{
	c->nothing = (struct ldmicro_var){ .name = "", .ours = "_", .bytes = 2 };
	return &c->nothing;
}

struct ldmicro_var *var_of(struct ldmicro_conversion *c, const char *name, bool bit)
{
	const uint32_t id = names_intern(&c->spelled, name, strlen(name));
	struct ldmicro_var *var;

	while ((uint32_t)c->of_count[bit] <= id)
		if (!arena_push(c->w.arena, &c->of[bit], &c->of_count[bit], sizeof(int)))
			return no_var(c);
	if (c->of[bit][id])
		return c->var[c->of[bit][id] - 1];
	var = var_new(c, names_text(&c->spelled, id), bit);
	if (!var)
		return no_var(c);
	c->of[bit][id] = c->vars;
	return var;
}

static struct ldmicro_var *own_new(struct ldmicro_conversion *c, const char *wish, bool bit, int bytes)
{
	struct ldmicro_var **slot, *var = arena_alloc(c->w.arena, sizeof(*var));

	slot = var ? arena_push(c->w.arena, &c->var, &c->vars, sizeof(*slot)) : NULL;
	if (!slot)
		return no_var(c);
	*var = (struct ldmicro_var){ .name = "", .bit = bit, .bytes = bytes };
	var->ours = w_name(&c->w, wish);
	*slot = var;
	return var;
}

const char *bit_new(struct ldmicro_conversion *c, const char *wish)
{
	return own_new(c, wish, true, 0)->ours;
}

const char *cut_new(struct ldmicro_conversion *c, int bytes)
{
	return own_new(c, "Cut", false, bytes)->ours;
}

const char *instance_new(struct ldmicro_conversion *c, const char *type, const char *wish)
{
	const char *name = w_name(&c->w, wish);
	void *slot = arena_push(c->w.arena, &c->instance, &c->instances, sizeof(*c->instance));

	if (!slot)
		return name;
	c->instance[c->instances - 1].type = type;
	c->instance[c->instances - 1].name = name;
	return name;
}

/* ---- what the whole program says of them ---- */

long long period_of(const struct ldmicro_conversion *c, const struct ldmicro_node *node)
{
	long long delay, adjust = c->program->old ? -1 : 0;
	const long long cycle = c->program->cycle_us;

	if (!ldmicro_number(node->arg[1], &delay))
		return 0;
	if (node->word != LDM_TON && node->word != LDM_TOF && node->word != LDM_RTO)
		adjust = 0;
	if (node->args > 2)
		ldmicro_number(node->arg[2], &adjust);
	delay = (delay + cycle * adjust) / cycle;
	return delay < 1 ? 1 : delay > 0x7fffffff ? 0x7fffffff : delay;
}

static int bytes_for(long long value)
{
	return value < -32768 || value > 32767 ? 4 : 2;
}

static void widen(struct ldmicro_var *var, long long value)
{
	if (bytes_for(value) > var->bytes)
		var->bytes = 4;
}

static void look_timer(struct ldmicro_conversion *c, const struct ldmicro_node *node)
{
	struct ldmicro_var *var = var_of(c, node->arg[0], false);
	const long long period = period_of(c, node);

	if (!period)
		return;
	widen(var, period);
	if (node->word == LDM_TOF)
		var->init = period;
}

static void look_counter(struct ldmicro_conversion *c, const struct ldmicro_node *node)
{
	struct ldmicro_var *var = var_of(c, node->arg[0], false);
	long long most, init = 0;

	if (ldmicro_number(node->arg[1], &most))
		widen(var, most);
	if (node->args < 3 || ldmicro_number(node->arg[2], &init)) {
		widen(var, init);
		var->init = init;
	}
}

/* Only of names that are timers or counters: others exist when an element uses them. */
static void count_use(struct ldmicro_conversion *c, const char *name)
{
	const uint32_t id = names_find(&c->spelled, name, strlen(name));

	if (id && (int)id < c->of_count[0] && c->of[0][id])
		c->var[c->of[0][id] - 1]->uses++;
}

/* Counts the uses of numbers, so that a timer that nothing else looks at is found. */
static void look_leaf(struct ldmicro_conversion *c, const struct ldmicro_node *node)
{
	const enum ldmicro_word word = node->word;

	if (word == LDM_CONTACTS || word == LDM_COIL)
		var_of(c, node->arg[0], true);
	if (word == LDM_CONTACTS || word == LDM_COIL || word == LDM_LABEL || word == LDM_SUBPROG ||
	    word == LDM_ENDSUB || word == LDM_COMMENT || word == LDM_UNKNOWN)
		return;
	if (word == LDM_GOTO || word == LDM_GOSUB || word == LDM_RETURN) {
		c->jumps = true;
		return;
	}
	if (word >= LDM_TON && word <= LDM_TLO)
		look_timer(c, node);
	if (word >= LDM_CTU && word <= LDM_CTR)
		look_counter(c, node);
	if (word == LDM_PERSIST)
		var_of(c, node->arg[0], false)->retain = true;
	for (int i = 0; i < node->args && i < 3; i++)
		count_use(c, node->arg[i]);
	if (node->word == LDM_SHIFT_REGISTER)
		for (int i = 0; i < LDMICRO_STAGES && i < ldmicro_int(node->arg[1]); i++)
			count_use(c, w_text(&c->w, "%s%d", node->arg[0], i));
}

/* Recursion is as deep as circuits: LDMICRO_DEPTH. */
static void look(struct ldmicro_conversion *c, const struct ldmicro_node *node)
{
	for (; node; node = node->next) {
		c->w.at.line = node->line;
		if (node->first)
			look(c, node->first);
		else if (node->word != LDM_SERIES && node->word != LDM_PARALLEL)
			look_leaf(c, node);
	}
}

static void take_sizes(struct ldmicro_conversion *c)
{
	for (int i = 0; i < c->program->sizes; i++) {
		const struct ldmicro_size *size = &c->program->size[i];
		struct ldmicro_var *var;

		if (size->bytes < 1 || size->bytes > 4 || size->bytes == 2)
			continue;
		c->w.at.line = size->line;
		var = var_of(c, size->name, false);
		var->bytes = size->bytes == 1 ? 1 : 4;
		if (size->bytes == 3)
			w_tell(&c->w, REPORT_CHANGED, "%s has 3 bytes there and 4 here", size->name);
	}
}

bool names_find_all(struct ldmicro_conversion *c)
{
	for (int i = 0; i < c->program->ios; i++) {
		const struct ldmicro_io *io = &c->program->io[i];

		c->w.at.line = io->line;
		var_of(c, io->name, strchr("XYIM", io->name[0]) != NULL);
		if (io->pin > 0)
			w_tell(&c->w, REPORT_LOST, "pin %d of the microcontroller: give %s a line in an I/O map",
			       io->pin, io->name);
	}
	take_sizes(c);
	/* Twice: an element may use a name before the one that makes it a timer. */
	for (int round = 0; round < 2; round++) {
		for (int i = 0; i < c->vars; i++)
			c->var[i]->uses = 0;
		for (int i = 0; i < c->program->rungs; i++)
			look(c, c->program->rung[i].first);
	}
	return !c->w.arena->failed;
}

/* ---- declarations ---- */

static void declare(const struct ldmicro_var *var, struct writing *w)
{
	w->at.line = var->line;
	w_put(w, "  %s%s%s : %s", var->ours, var->at ? " AT " : "", var->at ? var->at : "",
	      var->bit ? "BOOL" : type_of(var->bytes));
	if (var->init)
		w_put(w, " := %lld", var->init);
	w_put(w, ";");
	if (var->comment)
		w_put(w, " (* %s *)", var->comment);
	w_put(w, "\n");
}

void write_declarations_of(struct ldmicro_conversion *c, struct writing *w)
{
	bool retain = false;

	w_put(w, "VAR\n");
	for (int i = 0; i < c->vars; i++) {
		retain = retain || c->var[i]->retain;
		if (!c->var[i]->is_block && !c->var[i]->retain)
			declare(c->var[i], w);
	}
	w->at.line = 0;
	for (int i = 0; i < c->instances; i++)
		w_put(w, "  %s : %s;\n", c->instance[i].name, c->instance[i].type);
	w_put(w, "END_VAR\n\n");
	if (!retain)
		return;
	w_put(w, "VAR RETAIN\n");
	for (int i = 0; i < c->vars; i++)
		if (c->var[i]->retain)
			declare(c->var[i], w);
	w->at.line = 0;
	w_put(w, "END_VAR\n\n");
}

/* ---- blocks ---- */

/* Names, what a block does, and where its number is: N, or none. The comment is for people who
 * read the text. */
static const struct {
	const char *name, *comment, *variables, *body;
	bool timer, counter;
} blocks[BLOCKS] = {
	[BLOCK_TON] = { "LDM_TON", "counts scans while IN is TRUE; Q from P scans on", "",
		"  Q := IN AND N >= P;\n  IF NOT IN THEN\n    N := 0;\n  ELSIF NOT Q THEN\n    N := N + 1;\n  END_IF;\n",
		true, false },
	[BLOCK_TOF] = { "LDM_TOF", "Q stays TRUE for P scans after IN", "",
		"  Q := IN OR N < P;\n  IF IN THEN\n    N := 0;\n  ELSIF Q THEN\n    N := N + 1;\n  END_IF;\n",
		true, false },
	[BLOCK_RTO] = { "LDM_RTO", "adds up scans with IN; Q from P scans on", "",
		"  Q := N >= P;\n  IF IN AND NOT Q THEN\n    N := N + 1;\n  END_IF;\n", true, false },
	[BLOCK_RTL] = { "LDM_RTL", "adds up scans without IN; Q from P scans on", "",
		"  Q := N >= P;\n  IF NOT IN AND NOT Q THEN\n    N := N + 1;\n  END_IF;\n", true, false },
	[BLOCK_TCY] = { "LDM_TCY", "while IN is TRUE, Q changes after P + 1 scans", "  Half : BOOL;\n",
		"  IF NOT IN THEN\n    N := 0;\n  ELSIF N < P THEN\n    N := N + 1;\n  ELSE\n    N := 0;\n    Half := NOT Half;\n"
		"  END_IF;\n  Q := IN AND Half;\n", true, false },
	[BLOCK_THI] = { "LDM_THI", "a pulse of P scans", "  Begun : BOOL;\n",
		"  Begun := Begun OR IN;\n  Q := Begun AND N < P;\n  IF Q THEN\n    N := N + 1;\n"
		"  ELSIF Begun AND NOT IN THEN\n    N := 0;\n    Begun := FALSE;\n  END_IF;\n", true, false },
	[BLOCK_TLO] = { "LDM_TLO", "a gap of P scans", "  Begun : BOOL;\n  Was : BOOL;\n",
		"  IF IN THEN\n    Was := TRUE;\n  ELSIF Was THEN\n    Begun := TRUE;\n  END_IF;\n"
		"  IF NOT Begun THEN\n    Q := Was;\n  ELSIF N < P THEN\n    N := N + 1;\n    Q := FALSE;\n"
		"  ELSE\n    Q := TRUE;\n    IF IN THEN\n      N := 0;\n      Begun := FALSE;\n    END_IF;\n  END_IF;\n",
		true, false },
	[BLOCK_CTU] = { "LDM_CTU", "counts up to MOST; Q from MOST on", "",
		"  IF Step AND N < MOST THEN\n    N := N + 1;\n  END_IF;\n  Q := N >= MOST;\n", false, true },
	[BLOCK_CTD] = { "LDM_CTD", "counts down to MOST; Q above MOST", "",
		"  IF Step AND N > MOST THEN\n    N := N - 1;\n  END_IF;\n  Q := N > MOST;\n", false, true },
	[BLOCK_CTC] = { "LDM_CTC", "counts up and begins again behind MOST, with Q", "",
		"  Q := FALSE;\n  IF Step THEN\n    N := N + 1;\n    IF N > MOST THEN\n      N := FROM;\n      Q := TRUE;\n"
		"    END_IF;\n  END_IF;\n", false, true },
	[BLOCK_CTR] = { "LDM_CTR", "counts down and begins again below MOST, with Q", "",
		"  Q := FALSE;\n  IF Step THEN\n    N := N - 1;\n    IF N < MOST THEN\n      N := FROM;\n      Q := TRUE;\n"
		"    END_IF;\n  END_IF;\n", false, true },
	[BLOCK_OSC] = { "LDM_OSC", "while IN is TRUE, Q changes in each scan", "",
		"  Q := IN AND NOT Q;\n", false, false },
	[BLOCK_ODF] = { "LDM_ODF", "Q is FALSE for one scan when IN falls", "  Was : BOOL;\n  Fell : BOOL;\n",
		"  Q := IN OR Fell;\n  Fell := NOT IN AND (Fell OR Was);\n  Was := Was OR IN;\n", false, false },
	[BLOCK_NOTHING] = { "LDM_NOTHING", "stands for an element of LDmicro that has no equivalent; Q is IN if PASS", "",
		"  Q := IN AND PASS AND WHAT <> '';\n", false, false },
};

const char *block_of(struct ldmicro_conversion *c, enum ldmicro_block block, int bytes)
{
	const int type = bytes == 1 ? 0 : bytes == 2 ? 1 : 2;

	if (!c->block_name[block])
		c->block_name[block] = arena_alloc(c->w.arena, 3 * sizeof(char *));
	if (!c->block_name[block])
		return "";
	if (!c->needs[block][type])
		c->block_name[block][type] =
			w_name(&c->w, type == 1 ? blocks[block].name :
			       w_text(&c->w, "%s_%s", blocks[block].name, type_of(bytes)));
	c->needs[block][type] = true;
	return c->block_name[block][type];
}

static void write_block(const struct ldmicro_conversion *c, enum ldmicro_block block, int type,
			struct writing *w)
{
	const bool timer = blocks[block].timer, counter = blocks[block].counter;
	const char *count = type_of(type == 0 ? 1 : type == 1 ? 2 : 4);

	w_put(w, "(* %s *)\nFUNCTION_BLOCK %s ST\nVAR_INPUT\n  IN : BOOL;\n", blocks[block].comment,
	      c->block_name[block][type]);
	if (timer)
		w_put(w, "  P : DINT;\n");
	if (counter)
		w_put(w, "  MOST : %s;\n  FROM : %s := 0;\n  LATE : BOOL; (* FROM is no constant *)\n"
		      "  KIND : INT := 1; (* counts at 1: rising, 2: falling edges, 3: TRUE, 4: FALSE *)\n",
		      count, count);
	if (block == BLOCK_NOTHING)
		w_put(w, "  PASS : BOOL;\n  WHAT : STRING;\n");
	w_put(w, "END_VAR\nVAR_OUTPUT\n  Q : BOOL;\nEND_VAR\n");
	if (timer || counter)
		w_put(w, "VAR_IN_OUT\n  N : %s;\nEND_VAR\n", count);
	if (*blocks[block].variables || counter)
		w_put(w, "VAR\n%s%sEND_VAR\n", blocks[block].variables,
		      counter ? "  Begun : BOOL;\n  Last : BOOL;\n  Step : BOOL;\n" : "");
	if (counter)
		w_put(w, "  IF LATE AND NOT Begun THEN\n    N := FROM;\n  END_IF;\n  Begun := TRUE;\n"
		      "  CASE KIND OF\n    1: Step := IN AND NOT Last;\n    2: Step := Last AND NOT IN;\n"
		      "    3: Step := IN;\n    4: Step := NOT IN;\n  END_CASE;\n  Last := IN;\n");
	w_put(w, "%sEND_FUNCTION_BLOCK\n\n", blocks[block].body);
}

void write_blocks(struct ldmicro_conversion *c, struct writing *w)
{
	for (int block = 0; block < BLOCKS; block++)
		for (int type = 0; type < 3; type++)
			if (c->needs[block][type])
				write_block(c, (enum ldmicro_block)block, type, w);
}
