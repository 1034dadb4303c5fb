/* SPDX-License-Identifier: MIT
 *
 * sfc_view_offer - what could be meant by what is typed at a place of a chart: names,
 * addresses, steps, qualifiers.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include "editor-gtk/kit/entry_popup.h"

#include <string.h>

#define CANDIDATES 40

void chart_forget_uses(LadderSfcView *view)
{
	if (view->xref)
		xref_free(view->xref);
	g_clear_pointer(&view->xref, g_free);
}

struct entry_place chart_entry_place(LadderSfcView *view, bool output)
{
	struct project *project = ladder_document_project(view->document);

	if (!view->xref && project) {
		view->xref = g_new0(struct xref, 1);
		if (!xref_addresses(view->xref, project))
			chart_forget_uses(view);
	}
	return (struct entry_place){ .project = project, .pou = view->pou,
				     .output = output, .xref = view->xref };
}

/* ---- candidates ---- */

/* Where the word before the cursor begins. */
static gsize word_start(const char *line, gsize cursor)
{
	while (cursor > 0 && !strchr(" ,\t()", line[cursor - 1]))
		cursor--;
	return cursor;
}

/* @put: it takes the place of what stands from @start to @cursor. */
static void add_row(LadderSfcView *view, const char *line, gsize start, gsize cursor,
		    const char *put, const char *text, const char *address,
		    const char *note, const char *kind)
{
	char *whole = g_strdup_printf("%.*s%s%s", (int)start, line, put, line + cursor);
	struct entry_popup_row row = { .text = (char *)text, .address = (char *)address,
				       .note = (char *)note, .kind = (char *)kind,
				       .line = whole };

	ladder_entry_popup_add(LADDER_ENTRY_POPUP(view->entry), &row);
	g_free(whole);
}

static bool begins(const char *text, const char *line, gsize start, gsize cursor)
{
	return g_ascii_strncasecmp(text, line + start, cursor - start) == 0;
}

/* Variables, addresses and new names for the part of the line from @from on, as on the
 * sheet of rungs behind @head; no words that are elements. */
static void offer_names(LadderSfcView *view, const char *head, const char *line,
			gsize from, gsize cursor)
{
	const struct entry_place place = chart_entry_place(view, g_str_equal(head, "OUT "));
	struct entry_candidate *found = g_new(struct entry_candidate, CANDIDATES);
	char *part = g_strdup_printf("%s%s", head, line + from);
	const gsize skip = strlen(head);
	const int count = entry_candidates(&place, part, skip + cursor - from, found,
					   CANDIDATES);

	for (int i = 0; i < count; i++) {
		const struct entry_candidate *one = &found[i];

		if (one->kind != ENTRY_WORD && one->kind != ENTRY_ROUTINE &&
		    one->kind != ENTRY_LABEL && strlen(one->line) >= skip)
			add_row(view, line, from, strlen(line), one->line + skip, one->text,
				one->address, one->note, _(entry_kind_text(one->kind)));
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
					_("is it active?"), _("step"));
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

/* Which ones, by what is asked for. */
void chart_offer(LadderSfcView *view, enum chart_asked what, const char *line, gsize at)
{
	const gsize start = word_start(line, at);

	switch (what) {
	case ASK_CONDITION:
		offer_members(view, line, start, at);
		offer_names(view, "[", line, 0, at);
		break;
	case ASK_DOES:
	case ASK_ANOTHER:
		offer_doing(view, line, start, at);
		break;
	case ASK_LEAD:
	case ASK_WAIT:
	case ASK_GO:
		offer_steps(view, line, start, at);
		break;
	case ASK_STEP:
	case ASK_TIMES:
	case ASK_NAME:
	case ASK_PRIORITY:
	case ASK_COMMENT:
	default:
		break;
	}
}
