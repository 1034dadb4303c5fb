/* SPDX-License-Identifier: MIT
 *
 * rename - renames a thing and all its uses.
 *
 * The texts that contain the name are replaced in the project, the project is written,
 * and the texts are restored. The result is read again, and each name in it must still
 * mean the same. So no name is captured, whatever the rules of scope.
 */
#include "engine/ladder.h"

#include "engine/check/reserved.h"
#include "engine/model/fbd.h"
#include "engine/text/text.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

/* An original text of the project. */
struct kept {
	uint32_t *slot;
	uint32_t old;
};

struct rename {
	struct project *project;
	struct ladder_files files;
	struct xref before;
	struct xref_target target;
	const char *old, *name;
	struct kept *kept;
	int count;
	struct ladder_rename *how;
};

enum diag_id ladder_name_fault(const char *name)
{
	return reserved_fault(name);
}

static bool refuse(struct rename *r, enum ladder_refusal why, const struct xref_use *use)
{
	*r->how = (struct ladder_rename){ .why = why, .pou = -1 };
	if (!use)
		return false;
	r->how->pou = use->pou;
	r->how->rung = use->rung;
	r->how->row = use->row;
	r->how->col = use->col;
	return false;
}

/* ---- the target ---- */

static bool is_result(const struct project *project, const struct xref_target *target)
{
	const struct pou *pou;

	if (target->what != XREF_VARIABLE || target->table < 1 ||
	    target->table > project->pou_count)
		return false;
	pou = &project->pou[target->table - 1];
	return vars_flags(&pou->vars, target->index) & VAR_RESULT &&
	       !vars_is_eno(&pou->vars, target->index);
}

/* The name of a FUNCTION is also that of its result. */
static struct xref_target as_named(const struct project *project,
				   const struct xref_target *target)
{
	if (!is_result(project, target))
		return *target;
	return (struct xref_target){ .what = XREF_POU, .index = target->table - 1 };
}

static bool is_meant(const struct rename *r, const struct xref_target *target)
{
	const struct xref_target named = as_named(r->project, target);

	return xref_same(&named, &r->target);
}

/* The network, from 0, of which the target is a wire (model/fbd.h); -1: it is none. */
static int network_of(const struct project *project, const struct xref_target *target)
{
	const struct fbd *fbd = target->what == XREF_VARIABLE && target->table >= 1 &&
				target->table <= project->pou_count ? project->pou[target->table - 1].fbd : NULL;

	for (int i = 0; fbd && i < fbd->count; i++)
		if (target->index >= fbd->network[i].wire &&
		    target->index < fbd->network[i].wire + fbd->network[i].wires)
			return i;
	return -1;
}

/* Where it is declared; a wire is declared nowhere: its first use. */
static const struct xref_use *declaration(const struct rename *r)
{
	const bool wire = network_of(r->project, &r->target) >= 0;

	for (int i = 0; i < r->before.count; i++) {
		const struct xref_use *use = &r->before.use[i];

		if ((wire || use->kind == XREF_DECLARED) && xref_same(&use->target, &r->target))
			return use;
	}
	return NULL;
}

/* ---- is the name allowed? ---- */

static uint32_t fold_of(struct rename *r, const char *name)
{
	struct names *names = &r->project->names;

	return names_fold(names, names_intern(names, name, strlen(name)));
}

/* In a chart, steps, transitions, actions and variables share one scope. */
static bool is_local(const struct xref_target *target)
{
	return (target->what == XREF_VARIABLE && target->table > 0) ||
	       target->what == XREF_STEP || target->what == XREF_TRANSITION ||
	       target->what == XREF_ACTION;
}

static bool is_type(const struct xref_target *target)
{
	return target->what == XREF_POU || target->what == XREF_STRUCTURE ||
	       target->what == XREF_NAMED;
}

/* Whether both are in a scope where names must differ. */
static bool share_space(const struct project *project, const struct xref_target *a, const struct xref_target *b)
{
	bool a_type = is_type(a), b_type = is_type(b);
	bool a_global = a->what == XREF_VARIABLE && a->table == 0;
	bool b_global = b->what == XREF_VARIABLE && b->table == 0;

	if ((a_type || a_global) && (b_type || b_global))
		return true;
	if (is_local(a) && is_local(b))
		return a->table == b->table;
	if (a->what == XREF_VALUE && b->what == XREF_VALUE)
		return project->enum_value[a->index].enumeration ==
		       project->enum_value[b->index].enumeration;
	return a->what == b->what && !a_type && a->table == b->table;
}

/* Another wire of the same network may not have the name. */
static bool is_free_wire(struct rename *r)
{
	const int network = network_of(r->project, &r->target);
	struct xref_target other = r->target;

	if (network < 0)
		return true;
	other.index = fbd_wire(&r->project->names, &r->project->pou[r->target.table - 1], network, r->name,
			       strlen(r->name));
	for (int i = 0; i < r->before.count; i++)
		if (other.index >= 0 && other.index != r->target.index &&
		    xref_same(&r->before.use[i].target, &other))
			return refuse(r, RENAME_TAKEN, &r->before.use[i]);
	return true;
}

static bool is_free(struct rename *r)
{
	const uint32_t fold = fold_of(r, r->name);

	for (int i = 0; i < r->before.count; i++) {
		const struct xref_use *use = &r->before.use[i];

		if (use->kind == XREF_DECLARED && !xref_same(&use->target, &r->target) &&
		    share_space(r->project, &use->target, &r->target) &&
		    names_fold(&r->project->names, *use->slot) == fold)
			return refuse(r, RENAME_TAKEN, use);
	}
	return true;
}

/* Words that only some things cannot have as a name. */
static bool is_word(const struct rename *r)
{
	const struct project *project = r->project;
	const struct xref_target *target = &r->target;
	bool local = target->what == XREF_VARIABLE && target->table >= 1 &&
		     target->table <= project->pou_count;

	if (target->what == XREF_STRUCTURE || target->what == XREF_NAMED ||
	    (target->what == XREF_POU && pou_has_frame(&project->pou[target->index])))
		return words_is_taken(r->name);
	if (is_local(target) && target->table <= project->pou_count &&
	    project->pou[target->table - 1].sfc)
		return sfc_reserved(r->name);
	return local && project->pou[target->table - 1].kind == POU_FUNCTION &&
	       fold_of((struct rename *)(uintptr_t)r, r->name) ==
	       fold_of((struct rename *)(uintptr_t)r, "OUT");
}

static bool may_be_called(struct rename *r)
{
	switch ((int)reserved_fault(r->name)) {
	case DIAG_EXPECTED:
		return refuse(r, RENAME_FORM, NULL);
	case DIAG_RESERVED_NAME:
		return refuse(r, RENAME_RESERVED, NULL);
	default:
		if (is_word(r))
			return refuse(r, RENAME_RESERVED, NULL);
		return is_free_wire(r) && is_free(r);
	}
}

/* ---- the texts ---- */

/* The text of use @first with the new name in it and in later uses of the same text;
 * @first moves behind them. 0: no memory. */
static uint32_t new_text(struct rename *r, int *first)
{
	uint32_t *slot = r->before.use[*first].slot;
	const char *old = project_text(r->project, *slot);
	struct sink_memory memory;
	uint32_t id, done = 0;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	for (; *first < r->before.count && r->before.use[*first].slot == slot; ++*first) {
		const struct xref_use *use = &r->before.use[*first];

		if (!is_meant(r, &use->target))
			continue;
		sink_write(&sink, old + done, use->at - done);
		sink_text(&sink, r->name);
		done = use->at + use->len;
		r->how->places++;
	}
	sink_text(&sink, old + done);
	id = memory.failed ? 0 : names_intern(&r->project->names, memory.text,
					      memory.len);
	sink_memory_free(&memory);
	return id;
}

static bool exchange(struct rename *r)
{
	for (int i = 0; i < r->before.count;) {
		const struct xref_use *use = &r->before.use[i];
		struct kept *kept;
		uint32_t id;

		if (!is_meant(r, &use->target)) {
			i++;
			continue;
		}
		if (use->included)
			return refuse(r, RENAME_OTHER_FILE, use);
		if (!use->slot) {
			r->how->places++;
			i++;
			continue;
		}
		kept = arena_push(&r->before.arena, &r->kept, &r->count, sizeof(*kept));
		id = kept ? new_text(r, &i) : 0;
		if (!id) {
			r->count -= kept != NULL;
			return refuse(r, RENAME_MEMORY, NULL);
		}
		*kept = (struct kept){ use->slot, *use->slot };
		*use->slot = id;
	}
	return true;
}

/* The text of a box, whose statements have the new name. */
static bool exchange_text(void *context, uint32_t *slot, uint32_t text)
{
	struct rename *r = context;
	struct kept *kept = arena_push(&r->before.arena, &r->kept, &r->count, sizeof(*kept));

	if (!kept)
		return refuse(r, RENAME_MEMORY, NULL);
	*kept = (struct kept){ slot, *slot };
	*slot = text;
	return true;
}

/* Restores the last replacement first: a text may have been replaced twice. */
static void put_back(struct rename *r)
{
	for (int i = r->count - 1; i >= 0; i--)
		*r->kept[i].slot = r->kept[i].old;
}

/* Boxes and declarations take the word from its row. */
static void name_words(struct rename *r, const char *from, const char *to)
{
	const struct word_table *table = &r->project->words;
	bool structure = r->target.what == XREF_STRUCTURE;

	if (r->target.what == XREF_NAMED)
		r->project->named[r->target.index].name =
			names_intern(&r->project->names, to, strlen(to));
	if (r->target.what != XREF_POU && !structure)
		return;
	for (int i = 0; i < table->count; i++) {
		struct word_row *row = table->row[i];

		if (row->owner == r->target.index && strcmp(row->word, from) == 0 &&
		    (row->kind == WORD_STRUCT) == structure)
			row->word = to;
	}
}

/* ---- does the program still mean the same? ---- */

static int place_of_value(const struct project *project, int value)
{
	return value - project->enumeration[project->enum_value[value].enumeration].first;
}

/* `A, B : (Up, Down)` is written as two declarations, so values have other numbers. */
static bool is_same(const struct rename *r, const struct xref_target *before,
		    const struct xref *after, const struct xref_target *now)
{
	if (before->what != XREF_VALUE || now->what != XREF_VALUE)
		return xref_same(before, now);
	return place_of_value(r->project, before->index) ==
		       place_of_value(after->project, now->index) &&
	       r->project->enum_value[before->index].number ==
		       after->project->enum_value[now->index].number;
}

static bool same_meaning(struct rename *r, const struct xref *after)
{
	for (int i = 0; i < after->count && i < r->before.count; i++) {
		const struct xref_use *a = &r->before.use[i], *b = &after->use[i];

		if (a->kind != b->kind || !is_same(r, &a->target, after, &b->target))
			return refuse(r, RENAME_MEANING, a);
	}
	return after->count == r->before.count ? true :
	       refuse(r, RENAME_MEANING, NULL);
}

static bool is_same_program(struct rename *r, const char *text, size_t len)
{
	struct ladder *again = ladder_new();
	struct xref after;
	bool good;

	if (!again)
		return refuse(r, RENAME_MEMORY, NULL);
	ladder_set_files(again, &r->files);
	if (!ladder_load_text(again, r->project->file, text, len)) {
		ladder_free(again);
		return refuse(r, RENAME_MEANING, NULL);
	}
	good = xref_make(&after, ladder_project(again)) ? same_meaning(r, &after) :
	       refuse(r, RENAME_MEMORY, NULL);
	xref_free(&after);
	ladder_free(again);
	return good;
}

/* ---- rename ---- */

static char *written(struct rename *r, size_t *len)
{
	char *text = NULL;

	r->how->places = 0;
	if (exchange(r) && text_give_boxes(r->project, exchange_text, r)) {
		name_words(r, r->old, r->name);
		text = text_write(r->project, len);
		name_words(r, r->name, r->old);
		if (!text)
			refuse(r, RENAME_MEMORY, NULL);
	}
	put_back(r);
	return text;
}

char *ladder_rename(struct ladder *ladder, const struct xref_target *target,
		    const char *name, size_t *len, struct ladder_rename *how)
{
	struct rename r = { .project = ladder_project(ladder), .files = ladder_files(ladder),
			    .name = name, .how = how };
	const struct xref_use *declared;
	char *text = NULL;

	*how = (struct ladder_rename){ .why = RENAME_NOTHING, .pou = -1 };
	if (!r.project)
		return NULL;
	r.target = as_named(r.project, target);
	if (!xref_make(&r.before, r.project)) {
		refuse(&r, RENAME_MEMORY, NULL);
	} else if ((declared = declaration(&r)) && declared->slot && may_be_called(&r)) {
		how->why = RENAME_GOOD;
		r.old = project_text(r.project, *declared->slot);
		text = written(&r, len);
	}
	if (text && !is_same_program(&r, text, *len)) {
		free(text);
		text = NULL;
	}
	xref_free(&r.before);
	return text;
}
