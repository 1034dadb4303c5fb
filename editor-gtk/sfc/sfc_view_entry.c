/* SPDX-License-Identifier: MIT
 *
 * sfc_view_entry - what is asked for at a place of a chart: names, conditions, what a step
 * does, where ways lead.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/document/entry_outcome.h"
#include "editor-gtk/kit/entry_popup.h"

#include <stdlib.h>
#include <string.h>

/* What the popup that is open is for. It lives as long as that does. */
struct asked {
	LadderSfcView *view;
	enum chart_asked what;
	int index, use;      /* step or transition; line of a step             */
};

/* ---- while it is typed ---- */

static bool is_action(LadderSfcView *view, const char *name)
{
	const struct sfc *sfc = chart_pou(view)->sfc;

	for (int i = 0; i < sfc->action_count; i++)
		if (g_ascii_strcasecmp(project_text(view->sheet->project,
						    sfc->action[i].name), name) == 0)
			return true;
	return false;
}

/* The bit of a line of a step, as on the sheet of rungs. @doing: it was read. */
static void read_bit(LadderSfcView *view, const struct sfc_doing *doing,
		     struct entry *entry)
{
	const struct entry_place place = chart_entry_place(view, true);
	char *line = g_strdup_printf("OUT %s", doing->operand);

	memset(entry, 0, sizeof(*entry));
	if (!doing->action && !is_action(view, doing->name))
		entry_read(&place, line, entry);
	g_free(line);
}

/* What becomes of the line. A name that cannot be found is no reason to refuse it: the
 * step it belongs to may come later; but what the line says of one must be right. */
static char *outcome(const struct asked *asked, const char *line, struct entry *entry,
		     bool *good)
{
	LadderSfcView *view = asked->view;
	const struct entry_place place = chart_entry_place(view, false);
	struct sfc_doing doing;
	char *told;
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
		entry_condition(&place, line, entry);
		lenient = sfc_is_expression(line);
	} else {
		return g_strdup("");
	}
	told = entry_outcome_tell(view->document, view->pou, entry, line, good);
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

	*good = true;
	if (!view->entry || !view->sheet)
		return NULL; /* the popup is being made: it asks again */
	chart_offer(view, asked->what, line, at);
	entry = g_new(struct entry, 1);
	told = outcome(asked, line, entry, good);
	g_free(entry);
	return told;
}

/* ---- when it is taken ---- */

static bool put_doing(struct asked *asked, const struct sfc_doing *doing,
		      const struct entry *entry)
{
	LadderSfcView *view = asked->view;
	struct sfc_edit *edit;
	bool good;

	ladder_document_begin(view->document, _("Change what a step does"), NULL);
	edit = chart_edit(view);
	good = chart_put(view, edit, sfc_edit_set_use(edit, asked->index, asked->use, doing),
			 "", PIECE_STEP, asked->index) &&
	       entry_outcome_declare(view->document, view->pou, entry);
	ladder_document_end(view->document);
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
		edit = chart_edit(view);
		return chart_put(view, edit, sfc_edit_delete_use(edit, asked->use),
				 _("Change what a step does"), PIECE_STEP, asked->index);
	}
	entry = g_new(struct entry, 1);
	g_free(outcome(asked, line, entry, &good));
	good = good && sfc_doing_read(line, &doing) && put_doing(asked, &doing, entry);
	g_free(entry);
	return good;
}

/* As it is kept: without what the line says of its names. */
static bool put_condition(struct asked *asked, const char *line, const struct entry *entry)
{
	LadderSfcView *view = asked->view;
	const char *text = entry->sense == ENTRY_ELEMENT ? entry->operand : line;
	struct sfc_edit *edit;
	bool good;

	ladder_document_begin(view->document, _("Change condition"), NULL);
	edit = chart_edit(view);
	good = chart_put(view, edit, sfc_edit_set_condition(edit, asked->index, text), "",
			 PIECE_TRANSITION, asked->index) &&
	       entry_outcome_declare(view->document, view->pou, entry);
	ladder_document_end(view->document);
	return good;
}

static bool take_condition(struct asked *asked, const char *line)
{
	struct entry *entry = g_new(struct entry, 1);
	bool good;

	g_free(outcome(asked, line, entry, &good));
	good = good && put_condition(asked, line, entry);
	g_free(entry);
	return good;
}

/* Of a step: a new transition; of a transition: it leads there. */
static bool take_lead(struct asked *asked, const char *line)
{
	LadderSfcView *view = asked->view;
	struct sfc_edit *edit = chart_edit(view);
	int index, way = asked->index;

	if (chart_part(view, &index) == SFC_STEP) {
		const struct sfc *sfc = chart_pou(view)->sfc;
		int to = -1;

		for (int i = 0; i < sfc->step_count; i++)
			if (g_ascii_strcasecmp(view->sheet->name[i], line) == 0)
				to = i;
		if (to < 0)
			edit->why = N_("there is no step of this name");
		way = to < 0 ? -1 : sfc_edit_lead(edit, asked->index, to);
		return chart_put(view, edit, way >= 0, _(verb_row(VERB_lead_to)->label),
				 PIECE_TRANSITION, way);
	}
	return chart_put(view, edit, sfc_edit_set_ways(edit, way, true, line),
			 _(verb_row(VERB_lead_to)->label), PIECE_TRANSITION, way);
}

static bool take_times(struct asked *asked, const char *line)
{
	char *min = g_strdup(""), *max = g_strdup(""), *alarm = g_strdup("");
	char **words = g_strsplit_set(line, " ,", -1), **to = NULL;
	struct sfc_edit *edit = chart_edit(asked->view);
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
		edit->why = N_("write MIN time, MAX time, ALARM bit");
	good = chart_put(asked->view, edit, good && sfc_edit_set_times(edit, asked->index,
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
	struct sfc_edit *edit = chart_edit(asked->view);

	return step ? chart_put(asked->view, edit, sfc_edit_name_step(edit, asked->index,
								      line),
				_("Name a step"), PIECE_STEP, asked->index) :
		chart_put(asked->view, edit,
			  sfc_edit_name_transition(edit, asked->index, line),
			  _("Name a transition"), PIECE_TRANSITION, asked->index);
}

/* For one more step, by its name. */
static bool take_wait(struct asked *asked, const char *line)
{
	const struct sfc *sfc = chart_pou(asked->view)->sfc;
	struct sfc_edit *edit = chart_edit(asked->view);
	bool good = false;

	edit->why = N_("there is no step of this name");
	for (int i = 0; i < sfc->step_count; i++)
		if (g_ascii_strcasecmp(asked->view->sheet->name[i], line) == 0)
			good = sfc_edit_wait(edit, asked->index, i);
	return chart_put(asked->view, edit, good, _(verb_row(VERB_wait_for)->label),
			 PIECE_TRANSITION, asked->index);
}

/* 1 is asked first; nothing: by the order of the file. */
static bool take_priority(struct asked *asked, const char *line)
{
	struct sfc_edit *edit = chart_edit(asked->view);
	guint64 number = 0;
	bool good = !*line || g_ascii_string_to_unsigned(line, 10, 1, 65535, &number, NULL);

	if (!good)
		edit->why = N_("the priority is a number from 0 to 65535");
	good = good && sfc_edit_set_priority(edit, asked->index, (int)number);
	return chart_put(asked->view, edit, good, _("Change priority"), PIECE_TRANSITION,
			 asked->index);
}

static bool take_comment(struct asked *asked, const char *line)
{
	LadderSfcView *view = asked->view;
	struct sfc_edit *edit = chart_edit(view);
	const bool step = view->cursor.shape < edit->sfc.step_count;
	const struct sfc_at at = view->cursor;
	bool good;

	if (asked->use >= 0)
		good = sfc_edit_set_use_comment(edit, asked->use, line);
	else
		good = sfc_edit_set_comment(edit, step ? PIECE_STEP : PIECE_TRANSITION,
					    asked->index, line);
	good = chart_put(view, edit, good, _("Change comment"), step ? PIECE_STEP :
			 PIECE_TRANSITION, asked->index);
	if (good && asked->use >= 0)
		chart_go(view, at, false);
	return good;
}

static bool take_go(struct asked *asked, const char *line)
{
	LadderSfcView *view = asked->view;

	for (int i = 0; i < view->sheet->layout->sfc->step_count; i++)
		if (g_ascii_strcasecmp(view->sheet->name[i], line) == 0) {
			chart_go(view, (struct sfc_at){ i, -1, false }, false);
			return true;
		}
	chart_tell(view, _("there is no step of this name"));
	return false;
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
		default: break;
		}
	g_free(line);
	return good;
}

static void line_gone(void *context)
{
	struct asked *asked = context;
	LadderSfcView *view = asked->view;

	chart_entry_close(view);
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

static void line_left(void *context, const char *line)
{
	const struct asked *asked = context;
	char *told = g_strdup_printf(_("not taken: %s"), line);

	chart_tell(asked->view, told);
	g_free(told);
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
	const struct sfc *sfc = chart_pou(view)->sfc;

	return comment_text(project_text(view->sheet->project, asked->use >= 0 ?
		sfc->use[asked->use].comment : view->cursor.shape < sfc->step_count ?
		sfc->step[asked->index].comment : sfc->transition[asked->index].comment));
}

static char *text_now(const struct asked *asked)
{
	const struct pou *pou = chart_pou(asked->view);
	const struct project *project = asked->view->sheet->project;
	char line[LIMIT_NAME + 100];

	switch (asked->what) {
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
	case ASK_GO:
	case ASK_ANOTHER:
	case ASK_LEAD:
	case ASK_WAIT:
	default:
		return g_strdup("");
	}
}

static const char *prompt_of(enum chart_asked what)
{
	static const char *const prompts[] = {
		[ASK_STEP] = N_("Name of the step"),
		[ASK_CONDITION] = N_("Condition"),
		[ASK_DOES] = N_("What the step does: N Valve, L T#3s Horn, SET Lamp, "
				"ACTION Count"),
		[ASK_ANOTHER] = N_("What the step does: N Valve, L T#3s Horn, SET Lamp, "
				   "ACTION Count"),
		[ASK_LEAD] = N_("Lead to the step"),
		[ASK_WAIT] = N_("Wait also for the step"),
		[ASK_TIMES] = N_("MIN time, MAX time, ALARM bit"),
		[ASK_NAME] = N_("Name of the transition"),
		[ASK_PRIORITY] = N_("Priority: 1 is asked first"),
		[ASK_COMMENT] = N_("Comment"),
		[ASK_GO] = N_("Go to the step"),
	};

	return prompts[what];
}

/* Which part it is asked of; SFC_NOTHING: of step or transition. */
static enum sfc_part part_of(enum chart_asked what)
{
	switch (what) {
	case ASK_STEP:
	case ASK_DOES:
	case ASK_ANOTHER:
	case ASK_TIMES:
		return SFC_STEP;
	case ASK_CONDITION:
	case ASK_WAIT:
	case ASK_NAME:
	case ASK_PRIORITY:
		return SFC_TRANSITION;
	case ASK_LEAD:
	case ASK_COMMENT:
	case ASK_GO:
	default:
		return SFC_NOTHING;
	}
}

void chart_ask(LadderSfcView *view, enum chart_asked what, const char *typed)
{
	struct entry_popup_calls calls = { .changed = line_changed, .taken = line_taken,
					   .gone = line_gone,
					   .left = what != ASK_GO ? line_left : NULL };
	struct asked *asked;
	graphene_rect_t box;
	GdkRectangle cell;
	char *text;
	int index;
	enum sfc_part part = chart_part(view, &index);

	if (view->entry || !view->sheet || (what != ASK_GO && chart_is_fixed(view)))
		return;
	if (what != ASK_GO && (part == SFC_NOTHING || part == SFC_JUMP ||
			       (part_of(what) != SFC_NOTHING && part_of(what) != part))) {
		chart_tell(view, part_of(what) == SFC_STEP ?
			   _("the cursor is not on a step") :
			   _("the cursor is on no transition"));
		return;
	}
	asked = g_new0(struct asked, 1);
	*asked = (struct asked){ view, what, index,
				 what == ASK_DOES || what == ASK_COMMENT ?
				 view->cursor.use : -1 };
	calls.context = asked;
	text = typed ? g_strdup(typed) : text_now(asked);
	box = chart_box(view, view->cursor);
	cell = (GdkRectangle){ (int)((double)box.origin.x * view->zoom),
			       (int)((double)box.origin.y * view->zoom),
			       (int)((double)box.size.width * view->zoom),
			       (int)((double)box.size.height * view->zoom) };
	view->entry = ladder_entry_popup_new(GTK_WIDGET(view), _(prompt_of(what)), text,
					     typed != NULL, &calls);
	g_object_set_data_full(G_OBJECT(view->entry), "asked", asked, g_free);
	/* Now it can be filled. */
	ladder_entry_popup_ask(LADDER_ENTRY_POPUP(view->entry));
	ladder_entry_popup_show(LADDER_ENTRY_POPUP(view->entry), &cell);
	g_free(text);
}

/* A condition or an action that is rungs is edited where rungs are. */
static bool show_body(LadderSfcView *view, int index, enum sfc_part part)
{
	const struct sfc *sfc = chart_pou(view)->sfc;
	const struct sfc_body *body;

	if (part == SFC_TRANSITION)
		body = &sfc->transition[index].condition;
	else if (view->cursor.use >= 0 && sfc->use[view->cursor.use].action >= 0)
		body = &sfc->action[sfc->use[view->cursor.use].action].body;
	else
		return false;
	if (body->kind != BODY_RUNGS && body->kind != BODY_LIST)
		return false;
	chart_body_wanted(view, body);
	return true;
}

void chart_ask_here(LadderSfcView *view, const char *typed)
{
	int index;
	const enum sfc_part part = chart_part(view, &index);

	if (part == SFC_JUMP) {
		const struct sfc_jump *jump = &view->sheet->layout->jump[index];

		chart_go(view, (struct sfc_at){ jump->to_transition ? jump->from :
			view->sheet->layout->sfc->step_count + jump->from, -1, false },
			false);
		chart_ask(view, ASK_LEAD, typed);
		return;
	}
	if (part == SFC_NOTHING || (!typed && show_body(view, index, part)))
		return;
	chart_ask(view, part == SFC_TRANSITION ? ASK_CONDITION :
		  view->cursor.use >= 0 ? ASK_DOES : ASK_STEP, typed);
}

/* ---- closing ---- */

static gboolean drop_popup(gpointer popup)
{
	gtk_widget_unparent(popup);
	g_object_unref(popup);
	return G_SOURCE_REMOVE;
}

void chart_entry_close(LadderSfcView *view)
{
	GtkWidget *entry = view->entry;

	view->entry = NULL;
	if (!entry)
		return;
	ladder_entry_popup_close(LADDER_ENTRY_POPUP(entry));
	/* It may be what is calling. */
	g_idle_add(drop_popup, g_object_ref(entry));
}
