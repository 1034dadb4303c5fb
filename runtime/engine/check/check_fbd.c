/* SPDX-License-Identifier: MIT
 *
 * check_fbd - see check_fbd.h.
 */
#include "engine/check/check_fbd.h"

#include "engine/base/nearest.h"
#include "engine/check/check_st.h"
#include "engine/model/fbd.h"

#include <stdio.h>
#include <string.h>

/* A name in a line of the network. */
struct fbd_name {
	uint32_t fold;
	int item;
	enum fbd_use use;
	bool whole;
	const char *text;    /* in the text of the item                       */
	uint16_t len;
	int wire;            /* index of its variable; -1: it is no wire      */
};

struct fbd_check {
	struct operand_check *c;
	struct arena *scratch;
	const struct fbd_network *network;
	struct fbd_name *name;
	int names;
	uint8_t *reached;    /* by line: it depends on the one in question    */
	bool good;
};

static void said_name(struct fbd_check *f, enum diag_id id, const struct fbd_name *name, const char *more)
{
	char text[2 * LIMIT_ARG];

	snprintf(text, sizeof(text), "%.*s%s%s", name->len < LIMIT_ARG ? name->len : LIMIT_ARG - 1, name->text,
		 *more ? DIAG_AND : "", more);
	f->c->item = &f->c->pou->st->item[name->item];
	f->c->spot = name->text;
	f->good &= check_said(f->c, id, text);
}

static void note_names(struct fbd_check *f)
{
	struct operand_check *c = f->c;
	struct names *names = &c->project->names;

	f->name = NULL;
	f->names = 0;
	for (int i = f->network->first; i < f->network->first + f->network->count; i++) {
		struct fbd_names walk;
		struct token token;
		enum fbd_use use;
		bool whole;

		fbd_names_begin(&walk, names, &c->pou->st->item[i]);
		while (fbd_names_next(&walk, &token, &use, &whole)) {
			struct fbd_name *name = use == FBD_EDGE ? NULL :
				arena_push(f->scratch, &f->name, &f->names, sizeof(*name));

			if (name)
				*name = (struct fbd_name){
					.fold = names_fold(names, names_intern(names, token.text, token.len)),
					.item = i, .use = use, .whole = whole, .text = token.text,
					.len = (uint16_t)(token.len < LIMIT_NAME ? token.len : LIMIT_NAME),
					.wire = fbd_wire(names, c->pou, c->network, token.text, token.len),
				};
		}
	}
}

static bool is_source(const struct fbd_name *name)
{
	return name->use == FBD_WRITTEN || name->use == FBD_OUTPUT;
}

static bool is_written(const struct fbd_name *name)
{
	return is_source(name) || name->use == FBD_LATCHED || name->use == FBD_CALLED;
}

/* The number of the line as people count, without comments. */
static int line_number(const struct fbd_check *f, int item)
{
	return f->c->pou->st->item[item].line;
}

/* ---- wires ---- */

/* The names of variables of the POU and the project that may be meant. */
static void nearest_variable(const struct operand_check *c, const struct fbd_name *name, char *out, size_t size)
{
	struct nearest nearest;
	const struct var_table *tables[] = { &c->pou->vars, &c->project->globals };

	nearest_init(&nearest, name->text, name->len);
	for (size_t k = 0; k < sizeof(tables) / sizeof(*tables); k++)
		for (int i = 0; i < tables[k]->count; i++)
			if (!(vars_flags(tables[k], i) & VAR_SFC))
				nearest_offer(&nearest, project_text(c->project, tables[k]->var[i].name));
	nearest_print(&nearest, out, size);
}

/* A wire is written once, before it is read, and somebody reads it. */
static void check_wire(struct fbd_check *f, const struct fbd_name *source)
{
	char text[2 * LIMIT_ARG];
	bool read = false;

	for (const struct fbd_name *n = f->name; n < f->name + f->names; n++) {
		if (n->wire != source->wire || n == source)
			continue;
		if (is_source(n) && n < source)
			return; /* a second source: reported already */
		read |= n->use == FBD_READ || n->use == FBD_BEFORE;
		if (is_source(n)) {
			snprintf(text, sizeof(text), "%d", line_number(f, source->item));
			said_name(f, DIAG_FBD_TWO_SOURCES, n, text);
		} else if (n->use == FBD_LATCHED) {
			said_name(f, DIAG_FBD_LATCHED_WIRE, n, "");
		} else if (n->use == FBD_READ && n->item <= source->item) {
			snprintf(text, sizeof(text), "%d", line_number(f, source->item));
			said_name(f, n->item == source->item ? DIAG_FBD_LOOP_WIRE : DIAG_FBD_LATER_WIRE, n,
				  n->item == source->item ? "" : text);
		}
	}
	if (read)
		return;
	nearest_variable(f->c, source, text, sizeof(text));
	f->c->item = &f->c->pou->st->item[source->item];
	f->c->spot = source->text;
	f->good &= check_said(f->c, DIAG_FBD_UNREAD_WIRE, text);
}

/* ---- order ---- */

/* Marks the lines behind @item that use what it writes, directly or through others. */
static void reach(struct fbd_check *f, int item)
{
	const int first = f->network->first, count = f->network->count;

	memset(f->reached, 0, (size_t)count);
	f->reached[item - first] = 1;
	for (int at = 0; at < count; at++) {
		if (!f->reached[at])
			continue;
		for (const struct fbd_name *n = f->name; n < f->name + f->names; n++) {
			if (n->item != first + at || !is_written(n))
				continue;
			for (const struct fbd_name *k = n + 1; k < f->name + f->names; k++)
				if (k->item > n->item && k->fold == n->fold && !is_source(k))
					f->reached[k->item - first] = 1;
		}
	}
}

/* Does a line before @name write the same? */
static bool written_before(const struct fbd_check *f, const struct fbd_name *name)
{
	for (const struct fbd_name *n = f->name; n < f->name + f->names && n->item <= name->item; n++)
		if (n->fold == name->fold && is_written(n))
			return true;
	return false;
}

/* Does the line read what it writes, as a counter does? */
static bool keeps_itself(const struct fbd_check *f, const struct fbd_name *written)
{
	for (const struct fbd_name *n = f->name; n < f->name + f->names; n++)
		if (n->item == written->item && n->fold == written->fold && n->use == FBD_READ)
			return true;
	return written->use == FBD_LATCHED;
}

/* A line that reads what a later one writes gets the value of the scan before. That is meant where the later
 * one depends on it, and of a variable that is computed from its own value. */
static void check_order(struct fbd_check *f, const struct fbd_name *name)
{
	char text[16];

	if (name->use != FBD_READ || name->wire >= 0 || written_before(f, name))
		return;
	for (const struct fbd_name *n = name + 1; n < f->name + f->names; n++) {
		if (n->fold != name->fold || !is_written(n) || n->item <= name->item)
			continue;
		reach(f, name->item);
		if (!f->reached[n->item - f->network->first] && !keeps_itself(f, n)) {
			snprintf(text, sizeof(text), "%d", line_number(f, n->item));
			said_name(f, DIAG_FBD_ORDER, name, text);
		}
		return;
	}
}

/* ---- labels ---- */

static void check_jump(struct fbd_check *f, const struct st_item *item)
{
	struct operand_check *c = f->c;
	struct names *names = &c->project->names;
	const struct token name = st_label_name(names, item);
	struct nearest nearest;
	char text[2 * LIMIT_ARG];

	if (fbd_find_label(names, c->pou->fbd, names_fold(names, names_intern(names, name.text, name.len))) >= 0)
		return;
	nearest_init(&nearest, name.text, name.len);
	for (int i = 0; i < c->pou->fbd->count; i++)
		if (c->pou->fbd->network[i].label)
			nearest_offer(&nearest, project_text(c->project, c->pou->fbd->network[i].label));
	nearest_print(&nearest, text, sizeof(text));
	c->item = item;
	c->spot = name.text;
	f->good &= check_said(c, DIAG_FBD_NO_LABEL, text);
}

static void check_labels(struct fbd_check *f)
{
	struct operand_check *c = f->c;
	const struct fbd *fbd = c->pou->fbd;

	for (int i = 0; i < fbd->count; i++) {
		const uint32_t label = fbd->network[i].label;
		struct diag place = c->place;

		if (!label || fbd_find_label(&c->project->names, fbd, names_fold(&c->project->names, label)) == i)
			continue;
		place.id = DIAG_FBD_LABEL_TWICE;
		place.line = fbd->network[i].line;
		f->good &= diag_add(c->diags, place, "%s", project_text(c->project, label));
	}
}

/* ---- all ---- */

static void check_network(struct fbd_check *f)
{
	struct operand_check *c = f->c;

	note_names(f);
	f->reached = arena_alloc(f->scratch, (size_t)f->network->count + 1);
	if (!f->reached)
		return;
	for (const struct fbd_name *n = f->name; n < f->name + f->names; n++) {
		if (n->wire >= 0 && is_source(n))
			check_wire(f, n);
		check_order(f, n);
	}
	for (int i = f->network->first; i < f->network->first + f->network->count; i++) {
		const struct st_item *item = &c->pou->st->item[i];

		if (item->kind == ST_COMMENT)
			continue;
		f->good &= check_st_item(c, item);
		if (item->kind == ST_JUMP_IF)
			check_jump(f, item);
	}
}

bool check_fbd(struct operand_check *c, struct arena *scratch)
{
	struct fbd_check f = { .c = c, .scratch = scratch, .good = true };

	c->place = (struct diag){ .file = c->pou->file, .pou = project_text(c->project, c->pou->name) };
	check_labels(&f);
	for (int i = 0; i < c->pou->fbd->count; i++) {
		f.network = &c->pou->fbd->network[i];
		c->network = i;
		scope_network(c->scope, c->pou, i);
		if (!f.network->off)
			check_network(&f);
	}
	scope_network(c->scope, c->pou, -1);
	c->good = f.good;
	return f.good;
}
