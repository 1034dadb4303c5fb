/* SPDX-License-Identifier: MIT
 *
 * ldmicro_text - a program of LDmicro as the text of a rung file: its order, subroutines, labels,
 * the period.
 */
#include "engine/exchange/ldmicro/ldmicro_parts.h"

#include "engine/base/limits.h"

#include <string.h>

enum { USUAL_CYCLE = 10000, LEAST_CYCLE = LIMIT_TICK / 1000 };

static const struct ldmicro_node *begins_with(const struct ldmicro_rung *rung, enum ldmicro_word word)
{
	const struct ldmicro_node *node = rung->first;

	while (node && node->word != word)
		node = node->next;
	return node;
}

static bool has_master(const struct ldmicro_node *node)
{
	for (; node; node = node->next)
		if (node->word == LDM_MASTER_RELAY || (node->first && has_master(node->first)))
			return true;
	return false;
}

/* Which rungs are subroutines, and the names of labels. */
static bool find_parts(struct ldmicro_conversion *c)
{
	const int rungs = c->program->rungs;
	int open[LIMIT_CALLS] = { 0 }, depth = 0;

	c->owner = arena_alloc(c->w.arena, ((size_t)rungs + 1) * sizeof(*c->owner));
	c->target = arena_alloc(c->w.arena, (size_t)rungs + 1);
	c->label = arena_alloc(c->w.arena, ((size_t)rungs + 1) * sizeof(*c->label));
	c->subprogram = arena_alloc(c->w.arena, ((size_t)rungs + 1) * sizeof(*c->subprogram));
	if (!c->owner || !c->target || !c->label || !c->subprogram)
		return false;
	for (int i = 0; i < rungs; i++) {
		const struct ldmicro_node *sub = begins_with(&c->program->rung[i], LDM_SUBPROG);

		c->w.at.line = c->program->rung[i].line;
		if (sub && depth < LIMIT_CALLS) {
			open[depth++] = i;
			c->subprogram[i] = w_name(&c->w, sub->arg[0]);
		}
		c->owner[i] = depth ? open[depth - 1] : -1;
		if (begins_with(&c->program->rung[i], LDM_ENDSUB) && depth)
			depth--;
	}
	return true;
}

/* LDM_GOTO gives a label, or the number of a rung. */
static void find_targets(struct ldmicro_conversion *c, const struct ldmicro_node *node)
{
	for (; node; node = node->next) {
		long long number;

		if (node->first)
			find_targets(c, node->first);
		if (node->word != LDM_GOTO)
			continue;
		if (ldmicro_number(node->arg[0], &number) && number >= 1 && number <= c->program->rungs)
			c->target[number - 1] = true;
		for (int i = 0; i < c->program->rungs; i++) {
			const struct ldmicro_node *label = begins_with(&c->program->rung[i], LDM_LABEL);

			if (label && !strcmp(label->arg[0], node->arg[0])) {
				c->target[i] = true;
				break;
			}
		}
	}
}

static void name_labels_of(struct ldmicro_conversion *c)
{
	for (int i = 0; i < c->program->rungs; i++)
		find_targets(c, c->program->rung[i].first);
	for (int i = 0; i < c->program->rungs; i++) {
		const struct ldmicro_node *label = begins_with(&c->program->rung[i], LDM_LABEL);

		if (c->target[i])
			c->label[i] = w_name(&c->w, label ? label->arg[0] : w_text(&c->w, "Rung%d", i + 1));
	}
}

static void write_rungs_of(struct ldmicro_conversion *c, int owner)
{
	for (int i = 0; i < c->program->rungs; i++)
		if (c->owner[i] == owner)
			convert_ldmicro_rung(c, i);
	c->w.at.line = 0;
	if (c->pending_label || !c->w.rung)
		write_filler(c);
	for (int i = 0; i < c->pending_comment.count; i++)
		w_comment(&c->w, "", c->pending_comment.name[i]);
	c->pending_comment = (struct name_list){ NULL, 0 };
}

static void write_programs(struct ldmicro_conversion *c, const char *main)
{
	bool master = false;

	for (int i = 0; i < c->program->rungs; i++)
		master = master || has_master(c->program->rung[i].first);
	w_put(&c->w, "PROGRAM %s LD\n", main);
	c->w.pou = main;
	c->w.rung = 0;
	if (master) {
		c->master = bit_new(c, "MasterRelay");
		w_put(&c->w, "RUNG\n  | --- | COIL %s |\n", c->master);
		c->w.rung++;
	}
	write_rungs_of(c, -1);
	w_put(&c->w, "END_PROGRAM\n");
	for (int i = 0; i < c->program->rungs; i++) {
		if (!c->subprogram[i])
			continue;
		w_put(&c->w, "\nSUBROUTINE %s LD\n", c->subprogram[i]);
		c->w.pou = c->subprogram[i];
		c->w.rung = 0;
		write_rungs_of(c, i);
		w_put(&c->w, "END_SUBROUTINE\n");
	}
	c->w.pou = NULL;
}

/* ---- the report ---- */

static int count_done(const struct ldmicro_node *node)
{
	int count = 0;

	for (; node; node = node->next)
		count += node->first ? count_done(node->first) : node->piece != NULL;
	return count;
}

static void tell_missing(struct ldmicro_conversion *c, const struct ldmicro_node *node)
{
	for (; node; node = node->next) {
		c->w.at.line = node->line;
		if (node->first)
			tell_missing(c, node->first);
		else if (!node->piece && node->word != LDM_SERIES && node->word != LDM_PARALLEL)
			w_tell(&c->w, REPORT_LOST, "this element is missing in the result: %s",
			       w_string(&c->w, node->text, 70));
	}
}

static void tell_all(struct ldmicro_conversion *c)
{
	int done = 0;

	for (int i = 0; i < c->program->rungs; i++)
		done += count_done(c->program->rung[i].first);
	if (done < c->program->elements)
		for (int i = 0; i < c->program->rungs; i++)
			tell_missing(c, c->program->rung[i].first);
	c->w.at.line = 0;
	w_tell(&c->w, REPORT_TAKEN, "rungs: %d, elements: %d", c->program->rungs, done);
	for (int i = 0; i < c->program->settings; i++) {
		c->w.at.line = c->program->setting[i].line;
		w_tell(&c->w, REPORT_LOST, "this setting is not needed here: %s",
		       w_string(&c->w, c->program->setting[i].name, 70));
	}
}

static void find_cycle(struct ldmicro_conversion *c)
{
	const int given = c->program->cycle_us;

	c->w.at.line = c->program->cycle_line;
	if (!given || given < LEAST_CYCLE) {
		c->program->cycle_us = given ? LEAST_CYCLE : USUAL_CYCLE;
		w_tell(&c->w, REPORT_CHANGED, "a cycle takes %d us", c->program->cycle_us);
	}
	c->import->period_ns = c->program->cycle_us * INT64_C(1000);
}

static void write_configuration_of(const struct ldmicro_conversion *c, struct writing *w, const char *main)
{
	const int us = c->program->cycle_us;

	w_put(w, "\nCONFIGURATION Plc\n  TASK Cycle (INTERVAL := T#%d%s, PRIORITY := 1);\n"
		 "  PROGRAM Program1 WITH Cycle : %s;\nEND_CONFIGURATION\n", us % 1000 ? us : us / 1000,
	      us % 1000 ? "us" : "ms", main);
}

bool ldmicro_to_rung(struct import *import, struct ldmicro_program *program)
{
	struct ldmicro_conversion c = { .import = import, .program = program };
	struct writing whole;
	const char *main;

	writing_init(&c.w, import->arena, import->report);
	names_init(&c.spelled, import->arena);
	find_cycle(&c);
	main = w_name(&c.w, "Main");
	if (!find_parts(&c) || !names_find_all(&c))
		return false;
	name_labels_of(&c);
	write_programs(&c, main);
	tell_all(&c);
	writing_init(&whole, import->arena, import->report);
	w_put(&whole, "RUNGBOARD 1\n\n");
	if (*program->micro)
		w_comment(&whole, "", program->micro);
	write_blocks(&c, &whole);
	write_declarations_of(&c, &whole);
	w_add(&whole, &c.w.out);
	whole.at.line = 0;
	if (import->task)
		write_configuration_of(&c, &whole, main);
	import->text = whole.out;
	return !import->arena->failed && whole.out.text;
}

static bool read(struct import *import)
{
	struct ldmicro_program *program = ldmicro_read(import);
	const struct diag place = { .id = DIAG_NO_MEMORY, .file = import->path };

	if (!program)
		return false;
	return ldmicro_to_rung(import, program) || diag_add(import->diags, place, "%s", "");
}

const struct import_format ldmicro_format = { "LDmicro", ldmicro_is, NULL, read, true };
