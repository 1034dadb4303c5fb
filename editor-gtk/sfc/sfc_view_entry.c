/* SPDX-License-Identifier: MIT
 *
 * sfc_view_entry - the entry at the cursor of a chart, for names, conditions, lines of steps,
 * targets of ways; and its candidates.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include "editor-gtk/document/entry_outcome.h"
#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/kit/entry_popup.h"
#include "engine/base/name.h"

#include <stdlib.h>
#include <string.h>

#define CANDIDATES 40

/* The open question; it lives until the next one. */
struct asked {
	LadderSfcView *view;
	enum sfc_asked what;
	int index, use;      /* step or transition; line of a step             */
};

static struct entry_place place_of(LadderSfcView *view, bool output)
{
	return (struct entry_place){
		.project = ladder_document_project(view->canvas->document),
		.pou = view->canvas->pou, .output = output,
		.xref = canvas_uses(LADDER_CANVAS(view)),
	};
}

/* ---- candidates ---- */

/* Where the word before the cursor begins. */
static gsize word_start(const char *line, gsize cursor)
{
	while (cursor > 0 && !strchr(" ,\t()!/", line[cursor - 1]))
		cursor--;
	return cursor;
}

/* @put: replaces the line from @start to @cursor. */
static void add_row(LadderSfcView *view, const char *line, gsize start, gsize cursor,
		    const char *put, const char *text, const char *address,
		    const char *note, const char *kind)
{
	char *whole = g_strdup_printf("%.*s%s%s", (int)start, line, put, line + cursor);
	struct entry_popup_row row = { .text = (char *)text, .address = (char *)address,
				       .note = (char *)note, .kind = (char *)kind,
				       .line = whole };

	ladder_entry_popup_add(LADDER_ENTRY_POPUP(view->canvas->entry), &row);
	g_free(whole);
}

static bool begins(const char *text, const char *line, gsize start, gsize cursor)
{
	return name_begins(line + start, cursor - start, text, strlen(text));
}

/* Is it `Fill.X` or `Fill.T`? offer_members() has them. */
static bool is_member(LadderSfcView *view, const char *text)
{
	const char *dot = strrchr(text, '.');

	for (int i = 0; dot && dot[1] && !dot[2] && i < view->sheet->layout->sfc->step_count; i++)
		if (strncmp(view->sheet->name[i], text, (size_t)(dot - text)) == 0 &&
		    !view->sheet->name[i][dot - text])
			return dot[1] == 'X' || dot[1] == 'T';
	return false;
}

/* Replaces the line from @from on. @skip: bytes of the candidate's line before that. */
static void add_name(LadderSfcView *view, const char *line, gsize from,
		     const struct entry_candidate *one, gsize skip)
{
	char *whole = g_strdup_printf("%.*s%s", (int)from, line, one->line + skip);
	struct entry_popup_row row = {
		.text = (char *)one->text, .address = (char *)one->address,
		.note = (char *)one->note, .kind = (char *)_(entry_kind_text(one->kind)),
		.line = whole, .marked = one->kind == ENTRY_NEW,
	};

	ladder_entry_popup_add(LADDER_ENTRY_POPUP(view->canvas->entry), &row);
	g_free(whole);
}

/* Variables, addresses and new names for the line from @from on, as in the entry of a rung
 * behind @head; no words of elements. TRANSITION is the coil of a condition that is made of
 * rungs. */
static void offer_names(LadderSfcView *view, const char *head, const char *line,
			gsize from, gsize cursor)
{
	const struct entry_place place = place_of(view, g_str_equal(head, "OUT "));
	struct entry_candidate *found = g_new(struct entry_candidate, CANDIDATES);
	char *part = g_strdup_printf("%s%s", head, line + from);
	const gsize skip = strlen(head);
	const int count = entry_candidates(&place, part, skip + cursor - from, found,
					   CANDIDATES);

	for (int i = 0; i < count; i++) {
		const struct entry_candidate *one = &found[i];

		if (one->kind != ENTRY_WORD && one->kind != ENTRY_ROUTINE &&
		    one->kind != ENTRY_LABEL && strlen(one->line) >= skip &&
		    !is_member(view, one->text) && !g_str_equal(one->text, "TRANSITION"))
			add_name(view, line, from, one, skip);
	}
	g_free(part);
	g_free(found);
}

static void offer_steps(LadderSfcView *view, const char *line, gsize start, gsize cursor)
{
	for (int i = 0; i < view->sheet->layout->sfc->step_count; i++)
		if (begins(view->sheet->name[i], line, start, cursor))
			add_row(view, line, start, cursor, view->sheet->name[i],
				view->sheet->name[i], "", "", _("step"));
}

static void offer_members(LadderSfcView *view, const char *line, gsize start, gsize cursor)
{
	for (int i = 0; i < view->sheet->layout->sfc->step_count; i++)
		for (int k = 0; k < 2; k++) {
			char *name = g_strdup_printf("%s.%c", view->sheet->name[i],
						     k ? 'T' : 'X');

			if (cursor > start && begins(name, line, start, cursor))
				add_row(view, line, start, cursor, name, name, "", k ?
					_("how long it has been active") :
					_("TRUE while it is active"), _("step"));
			g_free(name);
		}
}

static void offer_doing(LadderSfcView *view, const char *line, gsize start, gsize cursor)
{
	const struct sfc *sfc = view->sheet->layout->sfc;
	struct sfc_doing doing;

	for (int i = 0; start == 0 && i < QUALIFIER_COUNT; i++) {
		char *word = g_strdup_printf("%s ", qualifier_word((enum qualifier)i));

		if (begins(word, line, start, cursor))
			add_row(view, line, start, cursor, word, word, "", "",
				_("qualifier"));
		g_free(word);
	}
	for (int i = 0; i < sfc->action_count; i++) {
		const char *name = project_text(view->sheet->project, sfc->action[i].name);

		if (begins(name, line, start, cursor))
			add_row(view, line, start, cursor, name, name, "", "",
				_("action"));
	}
	sfc_doing_read(line, &doing);
	offer_names(view, "OUT ", line, doing.operand && cursor >= (gsize)(doing.operand - line) ?
		    (gsize)(doing.operand - line) : start, cursor);
}

/* Candidates for the question. */
static void offer(LadderSfcView *view, enum sfc_asked what, const char *line, gsize at)
{
	const gsize start = word_start(line, at);

	if (what == ASK_CONDITION) {
		offer_members(view, line, start, at);
		offer_names(view, "[", line, 0, at);
	} else if (what == ASK_DOES || what == ASK_ANOTHER) {
		offer_doing(view, line, start, at);
	} else if (what == ASK_LEAD || what == ASK_WAIT || what == ASK_GO) {
		offer_steps(view, line, start, at);
	}
}

/* ---- each letter ---- */

static bool is_action(LadderSfcView *view, const char *name)
{
	const struct sfc *sfc = sfc_pou(view)->sfc;

	for (int i = 0; i < sfc->action_count; i++)
		if (name_equal(project_text(view->sheet->project, sfc->action[i].name), name))
			return true;
	return false;
}

/* Reads the bit of a step's line as the coil of a rung. */
static void read_bit(LadderSfcView *view, const struct sfc_doing *doing,
		     struct entry *entry)
{
	const struct entry_place place = place_of(view, true);
	char *line = g_strdup_printf("OUT %s", doing->operand);

	memset(entry, 0, sizeof(*entry));
	if (!doing->action && !is_action(view, doing->name))
		entry_read(&place, line, entry);
	g_free(line);
}

/* A condition as a file has it: `!Sensor` and `/Sensor` are `NOT Sensor`, as in a rung. Caller:
 * g_free. */
static char *condition_of(const char *line)
{
	const bool negated = *line == '!' || *line == '/';

	line += negated;
	return g_strconcat(negated ? "NOT " : "", line + strspn(line, " "), NULL);
}

static int step_named(LadderSfcView *view, const char *name);

/* A new variable with the name of a step: the step is meant. NULL: none. Caller: g_free. */
static char *is_step(LadderSfcView *view, const struct entry *entry)
{
	for (int i = 0; i < entry->declares; i++)
		if (step_named(view, entry->declare[i].name) >= 0)
			return g_strdup_printf(_("“%s” is a step; write %s.X, which is TRUE while it is active"),
					       entry->declare[i].name, entry->declare[i].name);
	return NULL;
}

/* The outcome to show. Unknown names are allowed, since steps may be added later; a
 * declaration in the line must be right. */
static char *outcome(const struct asked *asked, const char *line, struct entry *entry,
		     bool *good)
{
	LadderSfcView *view = asked->view;
	const struct entry_place place = place_of(view, false);
	struct sfc_doing doing;
	char *told, *condition;
	bool lenient;

	*good = true;
	memset(entry, 0, sizeof(*entry));
	if (!line[0])
		return g_strdup("");
	if (asked->what == ASK_DOES || asked->what == ASK_ANOTHER) {
		if (!sfc_doing_read(line, &doing)) {
			*good = false;
			return g_strdup(_(doing.why));
		}
		read_bit(view, &doing, entry);
		lenient = !doing.says;
	} else if (asked->what == ASK_CONDITION) {
		condition = condition_of(line);
		entry_condition(&place, condition, entry);
		lenient = sfc_is_expression(condition);
		g_free(condition);
		told = is_step(view, entry);
		if (told) {
			*good = false;
			return told;
		}
	} else {
		return g_strdup("");
	}
	told = entry_outcome_tell(view->canvas->document, view->canvas->pou, entry, line, good);
	canvas_blame(LADDER_CANVAS(view), entry);
	*good = *good || lenient;
	return told;
}

static char *line_changed(void *context, const char *line, int cursor, bool *good)
{
	struct asked *asked = context;
	LadderSfcView *view = asked->view;
	const gsize at = (gsize)(g_utf8_offset_to_pointer(line, cursor) - line);
	struct entry *entry;
	char *told;

	if (!view->sheet)
		return NULL;
	offer(view, asked->what, line, at);
	entry = g_new(struct entry, 1);
	told = outcome(asked, line, entry, good);
	g_free(entry);
	return told;
}

/* ---- Enter ---- */

static bool put_doing(struct asked *asked, const struct sfc_doing *doing,
		      const struct entry *entry)
{
	LadderSfcView *view = asked->view;
	struct sfc_edit *edit;
	bool good;

	ladder_document_begin(view->canvas->document, _("Change what a step does"), NULL);
	edit = sfc_edit_begin(view);
	good = sfc_put(view, edit, sfc_edit_set_use(edit, asked->index, asked->use, doing),
			 "", PIECE_STEP, asked->index) &&
	       entry_outcome_declare(view->canvas->document, view->canvas->pou, entry);
	ladder_document_end(view->canvas->document);
	return good;
}

static bool take_doing(struct asked *asked, const char *line)
{
	LadderSfcView *view = asked->view;
	struct sfc_edit *edit;
	struct sfc_doing doing;
	struct entry *entry;
	bool good;

	if (!line[0] && asked->use >= 0) {
		edit = sfc_edit_begin(view);
		return sfc_put(view, edit, sfc_edit_delete_use(edit, asked->use),
				 _("Change what a step does"), PIECE_STEP, asked->index);
	}
	entry = g_new(struct entry, 1);
	g_free(outcome(asked, line, entry, &good));
	good = good && sfc_doing_read(line, &doing) && put_doing(asked, &doing, entry);
	g_free(entry);
	return good;
}

/* Stores the condition without the declarations of the line. */
static bool put_condition(struct asked *asked, const char *line, const struct entry *entry)
{
	LadderSfcView *view = asked->view;
	char *text = sfc_is_expression(entry->operand) ? g_strdup(entry->operand) :
							 condition_of(line);
	struct sfc_edit *edit;
	bool good;

	ladder_document_begin(view->canvas->document, _("Change condition"), NULL);
	edit = sfc_edit_begin(view);
	good = sfc_put(view, edit, sfc_edit_set_condition(edit, asked->index, text), "",
			 PIECE_TRANSITION, asked->index) &&
	       entry_outcome_declare(view->canvas->document, view->canvas->pou, entry);
	ladder_document_end(view->canvas->document);
	g_free(text);
	return good;
}

static bool take_condition(struct asked *asked, const char *line)
{
	struct entry *entry = g_new(struct entry, 1);
	bool good;

	g_free(outcome(asked, line, entry, &good));
	good = good && entry->sense != ENTRY_PART && put_condition(asked, line, entry);
	g_free(entry);
	return good;
}

/* The step of this name; -1: there is none. */
static int step_named(LadderSfcView *view, const char *name)
{
	for (int i = 0; i < sfc_pou(view)->sfc->step_count; i++)
		if (name_equal(view->sheet->name[i], name))
			return i;
	return -1;
}

/* At a step: adds a transition to the named step; at a transition: it leads to that
 * step. */
static bool take_lead(struct asked *asked, const char *line)
{
	LadderSfcView *view = asked->view;
	struct sfc_edit *edit = sfc_edit_begin(view);
	int index, way = asked->index;

	if (sfc_part_at_cursor(view, &index) == SFC_STEP) {
		const int to = step_named(view, line);

		if (to < 0)
			edit->why = N_("There is no step with this name.");
		way = to < 0 ? -1 : sfc_edit_lead(edit, asked->index, to);
		return sfc_put(view, edit, way >= 0, _(verb_row(VERB_lead_to)->label),
				 PIECE_TRANSITION, way);
	}
	return sfc_put(view, edit, sfc_edit_set_ways(edit, way, true, line),
			 _(verb_row(VERB_lead_to)->label), PIECE_TRANSITION, way);
}

static bool take_times(struct asked *asked, const char *line)
{
	char *min = g_strdup(""), *max = g_strdup(""), *alarm = g_strdup("");
	char **words = g_strsplit_set(line, " ,", -1), **to = NULL;
	struct sfc_edit *edit = sfc_edit_begin(asked->view);
	bool good = true;

	for (char **word = words; *word; word++) {
		if (!**word || g_str_equal(*word, ":="))
			continue;
		if (g_ascii_strcasecmp(*word, "MIN") == 0) {
			to = &min;
		} else if (g_ascii_strcasecmp(*word, "MAX") == 0) {
			to = &max;
		} else if (g_ascii_strcasecmp(*word, "ALARM") == 0) {
			to = &alarm;
		} else if (to) {
			g_free(*to);
			*to = g_strdup(*word);
			to = NULL;
		} else {
			good = false;
		}
	}
	if (!good)
		edit->why = N_("Write MIN time, MAX time, ALARM bit, for example: "
			  "MIN T#2s MAX T#10s ALARM Late");
	good = sfc_put(asked->view, edit, good && sfc_edit_set_times(edit, asked->index,
			 min, max, alarm), _(verb_row(VERB_step_times)->label), PIECE_STEP,
			 asked->index);
	g_strfreev(words);
	g_free(min);
	g_free(max);
	g_free(alarm);
	return good;
}

static bool take_name(struct asked *asked, const char *line, bool step)
{
	struct sfc_edit *edit = sfc_edit_begin(asked->view);
	const bool good = step ? sfc_edit_name_step(edit, asked->index, line) :
			  sfc_edit_name_transition(edit, asked->index, line);

	return sfc_put(asked->view, edit, good, step ? _("Name a step") : _("Name a transition"),
		       step ? PIECE_STEP : PIECE_TRANSITION, asked->index);
}

/* The first step of an empty chart. */
static bool take_first(struct asked *asked, const char *line)
{
	struct sfc_edit *edit = sfc_edit_begin(asked->view);
	const int made = edit ? sfc_edit_first(edit, -1) : -1;

	return sfc_put(asked->view, edit, made >= 0 && sfc_edit_name_step(edit, made, line),
		       _(verb_row(VERB_step_below)->label), PIECE_STEP, made);
}

/* The transition also waits for the named step. */
static bool take_wait(struct asked *asked, const char *line)
{
	const int step = step_named(asked->view, line);
	struct sfc_edit *edit = sfc_edit_begin(asked->view);

	edit->why = N_("There is no step with this name.");
	return sfc_put(asked->view, edit,
		       step >= 0 && sfc_edit_wait(edit, asked->index, step), _(verb_row(VERB_wait_for)->label),
			 PIECE_TRANSITION, asked->index);
}

/* Priority 1 is evaluated first; an empty line: the order of the file. */
static bool take_priority(struct asked *asked, const char *line)
{
	struct sfc_edit *edit = sfc_edit_begin(asked->view);
	guint64 number = 0;
	bool good = !*line || g_ascii_string_to_unsigned(line, 10, 1, 65535, &number, NULL);

	if (!good)
		edit->why = N_("A priority is a number from 1 to 65535.");
	good = good && sfc_edit_set_priority(edit, asked->index, (int)number);
	return sfc_put(asked->view, edit, good, _("Change priority"), PIECE_TRANSITION,
			 asked->index);
}

static bool take_comment(struct asked *asked, const char *line)
{
	LadderSfcView *view = asked->view;
	struct sfc_edit *edit = sfc_edit_begin(view);
	const bool step = view->cursor.shape < edit->sfc.step_count;
	const struct sfc_at at = view->cursor;
	bool good;

	if (asked->use >= 0)
		good = sfc_edit_set_use_comment(edit, asked->use, line);
	else
		good = sfc_edit_set_comment(edit, step ? PIECE_STEP : PIECE_TRANSITION,
					    asked->index, line);
	good = sfc_put(view, edit, good, _("Change comment"), step ? PIECE_STEP :
			 PIECE_TRANSITION, asked->index);
	if (good && asked->use >= 0)
		sfc_go(view, at, false);
	return good;
}

static bool take_go(struct asked *asked, const char *line)
{
	const int step = step_named(asked->view, line);

	if (step < 0)
		canvas_tell(LADDER_CANVAS(asked->view), _("There is no step with this name."));
	else
		sfc_go(asked->view, (struct sfc_at){ step, -1, false }, false);
	return step >= 0;
}

static bool line_taken(void *context, const char *text)
{
	struct asked *asked = context;
	LadderSfcView *view = asked->view;
	struct asked kept = *asked;
	char *line = g_strstrip(g_strdup(text));
	bool good = false;

	if (view->sheet)
		switch (kept.what) {
		case ASK_STEP: good = take_name(&kept, line, true); break;
		case ASK_NAME: good = take_name(&kept, line, false); break;
		case ASK_CONDITION: good = take_condition(&kept, line); break;
		case ASK_DOES:
		case ASK_ANOTHER: good = take_doing(&kept, line); break;
		case ASK_LEAD: good = take_lead(&kept, line); break;
		case ASK_WAIT: good = take_wait(&kept, line); break;
		case ASK_TIMES: good = take_times(&kept, line); break;
		case ASK_PRIORITY: good = take_priority(&kept, line); break;
		case ASK_COMMENT: good = take_comment(&kept, line); break;
		case ASK_GO: good = take_go(&kept, line); break;
		case ASK_FIRST: good = take_first(&kept, line); break;
		default: break;
		}
	g_free(line);
	return good;
}

/* ---- asking ---- */

static char *times_now(const struct project *project, const struct sfc_step *step)
{
	GString *text = g_string_new(NULL);

	if (step->min)
		g_string_append_printf(text, "MIN %s ", project_text(project, step->min));
	if (step->max)
		g_string_append_printf(text, "MAX %s ", project_text(project, step->max));
	if (step->alarm)
		g_string_append_printf(text, "ALARM %s", project_text(project, step->alarm));
	return g_strchomp(g_string_free(text, FALSE));
}

static char *condition_now(const struct pou *pou, const struct project *project,
			   const struct sfc_body *body)
{
	return g_strdup(body->kind == BODY_EXPRESSION && body->count == 1 ?
			project_text(project, pou->rung[body->first]->cell[0].operand) : "");
}

static char *comment_now(const struct asked *asked)
{
	LadderSfcView *view = asked->view;
	const struct sfc *sfc = sfc_pou(view)->sfc;

	return comment_text(project_text(view->sheet->project, asked->use >= 0 ?
		sfc->use[asked->use].comment : view->cursor.shape < sfc->step_count ?
		sfc->step[asked->index].comment : sfc->transition[asked->index].comment));
}

static char *text_now(const struct asked *asked)
{
	const struct pou *pou = sfc_pou(asked->view);
	const struct project *project = asked->view->sheet->project;
	char line[LIMIT_NAME + 100];

	switch ((int)asked->what) {
	case ASK_STEP:
		return g_strdup(project_text(project, pou->sfc->step[asked->index].name));
	case ASK_NAME:
		return g_strdup(project_text(project,
					     pou->sfc->transition[asked->index].name));
	case ASK_CONDITION:
		return condition_now(pou, project,
				     &pou->sfc->transition[asked->index].condition);
	case ASK_DOES:
		sfc_doing_print(project, pou->sfc, asked->use, line, sizeof(line));
		return g_strdup(line);
	case ASK_TIMES:
		return times_now(project, &pou->sfc->step[asked->index]);
	case ASK_PRIORITY:
		return pou->sfc->transition[asked->index].priority ? g_strdup_printf("%d",
			pou->sfc->transition[asked->index].priority) : g_strdup("");
	case ASK_COMMENT:
		return comment_now(asked);
	default:
		return g_strdup("");
	}
}

#define DOES N_("What the step does: N Valve, L T#3s Horn, SET Lamp, ACTION Count, ACTION Count ST")

/* @part: where the question makes sense; SFC_NOTHING: at a step or a transition. */
static const struct { const char *prompt; enum sfc_part part; } questions[] = {
	[ASK_STEP] = { N_("Name of the step"), SFC_STEP },
	[ASK_CONDITION] = { N_("Condition"), SFC_TRANSITION },
	[ASK_DOES] = { DOES, SFC_STEP },
	[ASK_ANOTHER] = { DOES, SFC_STEP },
	[ASK_LEAD] = { N_("Lead to the step"), SFC_NOTHING },
	[ASK_WAIT] = { N_("Also wait for the step"), SFC_TRANSITION },
	[ASK_TIMES] = { N_("MIN time, MAX time, ALARM bit"), SFC_STEP },
	[ASK_NAME] = { N_("Name of the transition"), SFC_TRANSITION },
	[ASK_PRIORITY] = { N_("Priority: 1 is checked first"), SFC_TRANSITION },
	[ASK_COMMENT] = { N_("Comment"), SFC_NOTHING },
	[ASK_GO] = { N_("Go to the step"), SFC_NOTHING },
	[ASK_FIRST] = { N_("Name of the step"), SFC_NOTHING },
};

/* Why the question makes no sense at the cursor; NULL: it does. */
static const char *refusal(LadderSfcView *view, enum sfc_asked what)
{
	int index;
	const enum sfc_part part = sfc_part_at_cursor(view, &index), of = questions[what].part;

	if (what == ASK_GO || what == ASK_FIRST || (part != SFC_NOTHING && part != SFC_JUMP &&
			       (of == SFC_NOTHING || of == part)))
		return NULL;
	return of == SFC_STEP ? _("Select a step first.") :
				_("Select a transition first.");
}

void sfc_ask_for(LadderSfcView *view, enum sfc_asked what, const char *typed)
{
	struct canvas_question question = {
		.prompt = _(questions[what].prompt), .typed = typed != NULL, .drops = what == ASK_GO,
		.changed = line_changed, .taken = line_taken, .free = g_free,
	};
	struct asked *asked;
	char *text;
	int index;

	if (view->canvas->entry || !view->sheet ||
	    (what != ASK_GO && canvas_is_fixed(LADDER_CANVAS(view))))
		return;
	if (refusal(view, what)) {
		canvas_refuse(LADDER_CANVAS(view), question.prompt, refusal(view, what));
		return;
	}
	sfc_part_at_cursor(view, &index);
	asked = g_new0(struct asked, 1);
	*asked = (struct asked){ view, what, index,
				 what == ASK_DOES || what == ASK_COMMENT ?
				 view->cursor.use : -1 };
	text = typed ? g_strdup(typed) : text_now(asked);
	question.context = asked;
	question.text = text;
	question.spells = what == ASK_CONDITION || what == ASK_DOES || what == ASK_ANOTHER || what == ASK_TIMES;
	canvas_ask(LADDER_CANVAS(view), &question);
	g_free(text);
}

/* A condition or an action made of rungs is edited on a sheet of rungs. */
static bool show_body(LadderSfcView *view, int index, enum sfc_part part)
{
	const struct sfc *sfc = sfc_pou(view)->sfc;
	const struct sfc_body *body;

	if (part == SFC_TRANSITION)
		body = &sfc->transition[index].condition;
	else if (view->cursor.use >= 0 && sfc->use[view->cursor.use].action >= 0)
		body = &sfc->action[sfc->use[view->cursor.use].action].body;
	else
		return false;
	if (body->kind != BODY_RUNGS && body->kind != BODY_LIST && body->kind != BODY_ST)
		return false;
	sfc_want_body(view, body);
	return true;
}

void sfc_ask_here(LadderSfcView *view, const char *typed)
{
	int index;
	const enum sfc_part part = sfc_part_at_cursor(view, &index);

	if (part == SFC_JUMP) {
		const struct sfc_jump *jump = &view->sheet->layout->jump[index];

		sfc_go(view, (struct sfc_at){ jump->to_transition ? jump->from :
			view->sheet->layout->sfc->step_count + jump->from, -1, false },
			false);
		sfc_ask_for(view, ASK_LEAD, typed);
		return;
	}
	if (part == SFC_NOTHING && typed)
		sfc_ask_for(view, ASK_FIRST, typed);
	if (part == SFC_NOTHING || (!typed && show_body(view, index, part)))
		return;
	sfc_ask_for(view, part == SFC_TRANSITION ? ASK_CONDITION :
		  view->cursor.use >= 0 ? ASK_DOES : ASK_STEP, typed);
}
