/* SPDX-License-Identifier: MIT
 *
 * sfc_edit_text - names, conditions and lines of a chart that is edited; see sfc_edit.h.
 */
#include "editor-gtk/edit/sfc_edit.h"

#include "editor-gtk/edit/entry.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/sink.h"
#include "engine/model/expr.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define NO_MEMORY N_("out of memory")

/* ---- names ---- */

static bool is_called(const struct sfc_edit *edit, uint32_t id, const char *name)
{
	return id && strcasecmp(project_text(edit->project, id), name) == 0;
}

static bool is_taken(const struct sfc_edit *edit, const char *name)
{
	const struct sfc *sfc = &edit->sfc;
	const struct var_table *tables[] = { &edit->pou.vars, &edit->project->globals };

	for (int i = 0; i < sfc->step_count; i++)
		if (is_called(edit, sfc->step[i].name, name))
			return true;
	for (int i = 0; i < sfc->transition_count; i++)
		if (is_called(edit, sfc->transition[i].name, name))
			return true;
	for (int i = 0; i < sfc->action_count; i++)
		if (is_called(edit, sfc->action[i].name, name))
			return true;
	for (int t = 0; t < 2; t++)
		for (int i = 0; i < tables[t]->count; i++)
			if (is_called(edit, tables[t]->var[i].name, name))
				return true;
	return words_is_taken(name);
}

const char *sfc_edit_free_name(struct sfc_edit *edit, const char *base)
{
	char name[64];

	for (int i = 1;; i++) {
		snprintf(name, sizeof(name), "%.40s%d", base, i);
		if (!is_taken(edit, name))
			break;
	}
	return project_text(edit->project, sfc_edit_id(edit, name));
}

/* A name as the file has them, that nothing else has. */
static bool can_be_called(struct sfc_edit *edit, const char *name)
{
	struct lex lex;

	lex_init(&lex, name, strlen(name));
	if (lex_next(&lex) != TOKEN_NAME || lex.token.len != strlen(name) ||
	    lex.token.len > LIMIT_NAME || strchr(name, '.'))
		return sfc_edit_refuse(edit, N_("this is no name"));
	if (is_taken(edit, name))
		return sfc_edit_refuse(edit, N_("something has this name already"));
	return true;
}

static bool is_letter(char c)
{
	return ascii_digit(c) || (ascii_upper(c) >= 'A' && ascii_upper(c) <= 'Z') ||
	       c == '_' || (unsigned char)c >= 0x80;
}

/* Where @old, a point and X or T stand in @text as a name; NULL: nowhere. */
static const char *find_member(const char *text, const char *old)
{
	const size_t len = strlen(old);

	for (const char *at = text; *at; at++) {
		const bool begins = at == text ||
				    !(is_letter(at[-1]) || strchr(".#", at[-1]));

		if (begins && strncasecmp(at, old, len) == 0 && at[len] == '.' &&
		    strchr("XxTt", at[len + 1]) && at[len + 1] &&
		    !is_letter(at[len + 2]))
			return at;
	}
	return NULL;
}

/* The text with all of them called @name; 0: no memory. */
static uint32_t with_name(struct sfc_edit *edit, uint32_t id, const char *old,
			  const char *name)
{
	const char *text = project_text(edit->project, id), *found;
	struct sink_memory memory;
	struct sink sink;

	if (!id || !find_member(text, old))
		return id;
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	for (; (found = find_member(text, old)) != NULL; text = found + strlen(old)) {
		sink_write(&sink, text, (size_t)(found - text));
		sink_text(&sink, name);
	}
	sink_text(&sink, text);
	id = memory.failed ? 0 : sfc_edit_id(edit, sink_memory_text(&memory));
	sink_memory_free(&memory);
	return id;
}

/* A rung that may be changed, in the place of one that may not; it stands behind all
 * others, too, where those are that belong to the edit. NULL: no memory. */
static struct rung *own_copy(struct sfc_edit *edit, int at)
{
	struct rung **to = arena_push(&edit->arena, &edit->pou.rung,
				      &edit->pou.rung_count, sizeof(*to));

	if (!to)
		return NULL;
	*to = rung_copy(edit->pou.rung[at]);
	if (!*to)
		edit->pou.rung_count--;
	else
		edit->pou.rung[at] = *to;
	return edit->pou.rung[at];
}

/* Rungs are copied before they are changed. */
static bool rename_in_rungs(struct sfc_edit *edit, const char *old, const char *name)
{
	const int first = edit->pou.rung_count;

	for (int i = 0; i < first; i++) {
		struct rung *rung = edit->pou.rung[i];
		bool named = false;

		for (int c = 0; c < rung->rows * rung->cols; c++)
			named |= find_member(project_text(edit->project,
							  rung->cell[c].operand), old) ||
				 find_member(project_text(edit->project,
							  rung->cell[c].args), old);
		if (!named)
			continue;
		if (i < edit->rungs) {
			rung = own_copy(edit, i);
			if (!rung)
				return sfc_edit_refuse(edit, NO_MEMORY);
		}
		for (int c = 0; c < rung->rows * rung->cols; c++) {
			rung->cell[c].operand = with_name(edit, rung->cell[c].operand, old,
							  name);
			rung->cell[c].args = with_name(edit, rung->cell[c].args, old, name);
		}
	}
	return true;
}

static bool rename_in_list(struct sfc_edit *edit, const char *old, const char *name)
{
	struct il_line *line = arena_alloc(&edit->arena, ((size_t)edit->pou.il.count + 1) *
					   sizeof(*line));

	if (!line)
		return sfc_edit_refuse(edit, NO_MEMORY);
	if (edit->pou.il.count)
		memcpy(line, edit->pou.il.line, (size_t)edit->pou.il.count * sizeof(*line));
	for (int i = 0; i < edit->pou.il.count; i++)
		line[i].operand = with_name(edit, line[i].operand, old, name);
	edit->pou.il.line = line;
	return true;
}

/* Times and bits of steps and of what they do. */
static void rename_in_steps(struct sfc_edit *edit, const char *old, const char *name)
{
	struct sfc *sfc = &edit->sfc;

	for (int i = 0; i < sfc->use_count; i++) {
		sfc->use[i].time = with_name(edit, sfc->use[i].time, old, name);
		sfc->use[i].operand = with_name(edit, sfc->use[i].operand, old, name);
	}
	for (int i = 0; i < sfc->step_count; i++) {
		sfc->step[i].min = with_name(edit, sfc->step[i].min, old, name);
		sfc->step[i].max = with_name(edit, sfc->step[i].max, old, name);
		sfc->step[i].alarm = with_name(edit, sfc->step[i].alarm, old, name);
	}
}

bool sfc_edit_asks_for(const struct sfc_edit *edit, int step)
{
	const struct sfc *sfc = &edit->sfc;
	const char *name = project_text(edit->project, sfc->step[step].name);
	bool found = false;

	for (int i = 0; i < edit->pou.rung_count && !found; i++) {
		const struct rung *rung = edit->pou.rung[i];

		for (int c = 0; c < rung->rows * rung->cols; c++)
			found |= find_member(project_text(edit->project,
						rung->cell[c].operand), name) ||
				 find_member(project_text(edit->project,
						rung->cell[c].args), name);
	}
	for (int i = 0; i < edit->pou.il.count && !found; i++)
		found = find_member(project_text(edit->project,
						 edit->pou.il.line[i].operand), name);
	for (int i = 0; i < sfc->use_count && !found; i++)
		found = find_member(project_text(edit->project, sfc->use[i].time), name);
	for (int i = 0; i < sfc->step_count && !found; i++)
		found = find_member(project_text(edit->project, sfc->step[i].min), name) ||
			find_member(project_text(edit->project, sfc->step[i].max), name);
	return found;
}

bool sfc_edit_name_step(struct sfc_edit *edit, int step, const char *name)
{
	struct sfc *sfc = &edit->sfc;
	const uint32_t old = sfc->step[step].name;
	const uint32_t id = sfc_edit_id(edit, name);

	if (names_fold(&edit->project->names, id) !=
	    names_fold(&edit->project->names, old) && !can_be_called(edit, name))
		return false;
	sfc->step[step].name = id;
	for (int i = 0; i < sfc->ref_count; i++)
		if (sfc->ref[i].step == step)
			sfc->ref[i].name = id;
	rename_in_steps(edit, project_text(edit->project, old), name);
	return rename_in_rungs(edit, project_text(edit->project, old), name) &&
	       rename_in_list(edit, project_text(edit->project, old), name);
}

bool sfc_edit_name_transition(struct sfc_edit *edit, int transition, const char *name)
{
	if (*name && !is_called(edit, edit->sfc.transition[transition].name, name) &&
	    !can_be_called(edit, name))
		return false;
	edit->sfc.transition[transition].name = sfc_edit_id(edit, name);
	return true;
}

bool sfc_edit_set_priority(struct sfc_edit *edit, int transition, int priority)
{
	if (priority < 0 || priority > 65535)
		return sfc_edit_refuse(edit, N_("this is no priority"));
	edit->sfc.transition[transition].priority = priority;
	return true;
}

bool sfc_edit_set_kind(struct sfc_edit *edit, int step, enum step_kind kind)
{
	if (edit->sfc.step[step].kind == STEP_MACRO || kind == STEP_MACRO)
		return sfc_edit_refuse(edit, N_("a macro-step stays one"));
	edit->sfc.step[step].kind = kind;
	return true;
}

/* One operand or literal: what stands between commas in the file. */
static bool is_word(const char *text)
{
	return strlen(text) < 200 && !strpbrk(text, ",;()|\n\r\t \"");
}

bool sfc_edit_set_times(struct sfc_edit *edit, int step, const char *min, const char *max,
			const char *alarm)
{
	struct sfc_step *s = &edit->sfc.step[step];

	if (!is_word(min) || !is_word(max) || !is_word(alarm))
		return sfc_edit_refuse(edit, N_("this is no time and no bit"));
	s->min = sfc_edit_id(edit, min);
	s->max = sfc_edit_id(edit, max);
	s->alarm = sfc_edit_id(edit, alarm);
	return true;
}

/* ---- conditions ---- */

bool sfc_is_expression(const char *text)
{
	struct expr *expr = calloc(1, sizeof(*expr));
	struct diag_list *diags = calloc(1, sizeof(*diags));
	bool good = expr && diags;

	if (good) {
		diag_init(diags);
		good = expr_parse_text(text, strlen(text), expr, diags,
				       (struct diag){ .id = DIAG_BAD_EXPRESSION }) &&
		       !expr->target;
	}
	free(expr);
	free(diags);
	return good;
}

static struct rung *expression_rung(struct sfc_edit *edit, const char *text)
{
	struct rung *rung = rung_new(1, 2);

	if (!rung)
		return NULL;
	rung->cell[0].word = ELEM_COMPARE;
	rung->cell[0].operand = sfc_edit_id(edit, text);
	rung->cell[1].word = ELEM_COIL;
	rung->cell[1].operand = sfc_edit_id(edit, SFC_CONDITION);
	return rung;
}

bool sfc_edit_set_condition(struct sfc_edit *edit, int transition, const char *text)
{
	struct sfc_body *body = &edit->sfc.transition[transition].condition;
	struct rung *rung, **to;

	if (!*text) {
		*body = (struct sfc_body){ BODY_NONE, 0, 0 };
		return true;
	}
	if (strpbrk(text, ";|\n\r") || strlen(text) > 4000 || !sfc_is_expression(text))
		return sfc_edit_refuse(edit, N_("this is no expression"));
	rung = expression_rung(edit, text);
	to = rung ? arena_push(&edit->arena, &edit->pou.rung, &edit->pou.rung_count,
			       sizeof(*to)) : NULL;
	if (!to) {
		rung_free(rung);
		return sfc_edit_refuse(edit, NO_MEMORY);
	}
	*to = rung;
	*body = (struct sfc_body){ BODY_EXPRESSION, edit->pou.rung_count - 1, 1 };
	return true;
}

bool sfc_edit_as_rung(struct sfc_edit *edit, int transition)
{
	struct sfc_body *body = &edit->sfc.transition[transition].condition;

	if (body->kind == BODY_NONE && !sfc_edit_set_condition(edit, transition, "TRUE"))
		return false;
	if (body->kind == BODY_LIST)
		return sfc_edit_refuse(edit, N_("this condition is a list"));
	body->kind = BODY_RUNGS;
	return true;
}

/* ---- what a step does ---- */

static const char *skip(const char *at)
{
	return at + strspn(at, " \t,");
}

/* The next word of a line; false: there is none. */
static bool next_word(const char **at, char *out, size_t size)
{
	size_t len;

	*at = skip(*at);
	len = strcspn(*at, " \t,");
	snprintf(out, size, "%.*s", (int)(len < size ? len : size - 1), *at);
	*at += len;
	return len > 0 && len < size;
}

/* `L T#3s`, `SET`, `N`, if it is not the name itself; false: something is missing. */
static bool take_qualifier(const char **at, struct sfc_doing *out)
{
	const char *behind = *at;
	char word[LIMIT_NAME + 1];
	enum qualifier found;

	if (!next_word(&behind, word, sizeof(word)) || !*skip(behind))
		return true;
	found = qualifier_find(word, strlen(word));
	if (strcasecmp(word, "SET") == 0)
		out->kind = USE_SET;
	else if (strcasecmp(word, "RESET") == 0)
		out->kind = USE_RESET;
	else if (found != QUALIFIER_COUNT)
		out->qualifier = found;
	else
		return true;
	*at = behind;
	if (out->kind != USE_ACTION || !qualifier_has_time(found))
		return true;
	out->why = N_("a time and a name belong to this qualifier");
	return next_word(at, out->time, sizeof(out->time)) && *skip(*at);
}

/* Its name, with what the line says of it. */
static bool take_operand(const char *at, bool qualified, struct sfc_doing *out)
{
	char word[LIMIT_NAME + 1];
	size_t len;

	out->operand = skip(at);
	len = entry_declared_len(out->operand, strlen(out->operand), ENTRY_WORD_GIVEN);
	if (len > 0 && len <= LIMIT_NAME) {
		snprintf(out->name, sizeof(out->name), "%.*s", (int)len, out->operand);
		out->says = true;
		return true;
	}
	if (!next_word(&at, word, sizeof(word)))
		return false;
	if (!is_word(word) || *skip(at)) {
		out->why = qualified ? N_("too many words") :
				       N_("there is no such qualifier");
		return false;
	}
	snprintf(out->name, sizeof(out->name), "%s", word);
	return true;
}

bool sfc_doing_read(const char *line, struct sfc_doing *out)
{
	const char *begin = skip(line), *at = begin, *behind;
	char word[LIMIT_NAME + 1];

	memset(out, 0, sizeof(*out));
	out->why = N_("the name of an action or a bit is missing");
	if (!entry_declared_len(at, strlen(at), ENTRY_WORD_POSSIBLE) &&
	    !take_qualifier(&at, out))
		return false;
	behind = at;
	if (next_word(&behind, word, sizeof(word)) && strcasecmp(word, "ACTION") == 0) {
		out->action = true;
		at = behind;
	}
	if (!take_operand(at, at != begin, out))
		return false;
	out->why = NULL;
	return true;
}

void sfc_doing_print(const struct project *project, const struct sfc *sfc, int use,
		     char *out, size_t size)
{
	const struct sfc_use *u = &sfc->use[use];
	const char *name = project_text(project, u->operand);

	if (u->kind != USE_ACTION)
		snprintf(out, size, "%s %s", u->kind == USE_SET ? "SET" : "RESET", name);
	else
		snprintf(out, size, "%s %s%s%s", qualifier_word(u->qualifier),
			 project_text(project, u->time), u->time ? " " : "", name);
}

/* An empty one. */
static bool new_action(struct sfc_edit *edit, const char *name)
{
	struct sfc *sfc = &edit->sfc;
	struct sfc_action *action;
	struct rung **to;

	if (!can_be_called(edit, name))
		return false;
	action = arena_push(&edit->arena, &sfc->action, &sfc->action_count,
			    sizeof(*action));
	to = action ? arena_push(&edit->arena, &edit->pou.rung, &edit->pou.rung_count,
				 sizeof(*to)) : NULL;
	if (!to)
		return sfc_edit_refuse(edit, NO_MEMORY);
	*to = rung_new(1, 1);
	if (!*to) {
		edit->pou.rung_count--;
		return sfc_edit_refuse(edit, NO_MEMORY);
	}
	*action = (struct sfc_action){ .name = sfc_edit_id(edit, name),
		.body = { BODY_RUNGS, edit->pou.rung_count - 1, 1 } };
	return sfc_edit_put_piece(edit, sfc->piece_count - 1, PIECE_ACTION,
				 sfc->action_count - 1);
}

/* The lines of a step behind all others, with room for one more; without @skip. */
static bool copy_uses(struct sfc_edit *edit, int step, int skip, bool more)
{
	struct sfc *sfc = &edit->sfc;
	const int old = sfc->step[step].first_use, count = sfc->step[step].use_count;
	const int first = sfc->use_count;

	for (int i = old; i < old + count + more; i++) {
		struct sfc_use *to;

		if (i == skip)
			continue;
		to = arena_push(&edit->arena, &sfc->use, &sfc->use_count, sizeof(*to));
		if (!to)
			return sfc_edit_refuse(edit, NO_MEMORY);
		*to = i < old + count ? sfc->use[i] : (struct sfc_use){ .step = step };
	}
	sfc->step[step].first_use = first;
	sfc->step[step].use_count = sfc->use_count - first;
	return true;
}

bool sfc_edit_set_use(struct sfc_edit *edit, int step, int use,
		      const struct sfc_doing *doing)
{
	struct sfc_step *s = &edit->sfc.step[step];
	const int line = use < 0 ? s->use_count : use - s->first_use;
	struct sfc_use *to;

	if (use < 0 && s->use_count >= LIMIT_STEP_USES)
		return sfc_edit_refuse(edit, N_("this step does too much"));
	if ((doing->action && !new_action(edit, doing->name)) ||
	    !copy_uses(edit, step, -1, use < 0))
		return false;
	to = &edit->sfc.use[edit->sfc.step[step].first_use + line];
	to->more = to->kind == doing->kind ? to->more : 0;
	to->kind = doing->kind;
	to->qualifier = doing->qualifier;
	to->operand = sfc_edit_id(edit, doing->name);
	to->time = sfc_edit_id(edit, doing->time);
	return true;
}

bool sfc_edit_delete_use(struct sfc_edit *edit, int use)
{
	return copy_uses(edit, edit->sfc.use[use].step, use, false);
}
