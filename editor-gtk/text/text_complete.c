/* SPDX-License-Identifier: MIT
 *
 * text_complete - syntax colours of IL, ST and rung files, and completion.
 */
#include "editor-gtk/text/text_complete.h"

#include "editor-gtk/document/plain_file.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/name_fold.h"
#include "editor-gtk/text/st_typing.h"

#include "engine/base/ascii.h"
#include "engine/base/name.h"

#include <stdlib.h>
#include <string.h>

static GtkSourceLanguage *language(const char *id)
{
	GtkSourceLanguageManager *manager = gtk_source_language_manager_get_default();
	static gsize added;

	if (g_once_init_enter(&added)) {
		gtk_source_language_manager_append_search_path(manager,
			"resource:///org/rungboard/Editor/language-specs");
		g_once_init_leave(&added, 1);
	}
	return gtk_source_language_manager_get_language(manager, id);
}

GtkSourceLanguage *text_language(void)
{
	return language("rung");
}

GtkSourceLanguage *text_language_st(bool st)
{
	return language(st ? "rung-st" : "rung");
}

bool text_is_st(const struct pou *pou)
{
	return pou->language == LANGUAGE_ST || pou->fbd || (pou->sfc && pou->st) || pou->boxed_count > 0;
}

GtkSourceLanguage *text_language_of(LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);
	const char *path = ladder_document_path(document);
	const bool st = pou < 0 ? path && plain_file_is(path) :
		project && pou < project->pou_count &&
		text_is_st(&project->pou[pou]);

	return text_language_st(st);
}

/* ---- a candidate ---- */

#define LADDER_TYPE_PROPOSAL (ladder_proposal_get_type())
G_DECLARE_FINAL_TYPE(LadderProposal, ladder_proposal, LADDER, PROPOSAL, GObject)

struct _LadderProposal {
	GObject parent;
	char *text, *kind, *note;
	char *key;          /* by which it is sorted                           */
	int rank;           /* kinds that are meant more often stand above      */
	bool skeleton;      /* a whole statement begins with it                 */
};

static char *typed_text(GtkSourceCompletionProposal *proposal)
{
	return g_strdup(LADDER_PROPOSAL(proposal)->text);
}

static void proposal_interface(GtkSourceCompletionProposalInterface *interface)
{
	interface->get_typed_text = typed_text;
}

G_DEFINE_FINAL_TYPE_WITH_CODE(LadderProposal, ladder_proposal, G_TYPE_OBJECT,
	G_IMPLEMENT_INTERFACE(GTK_SOURCE_TYPE_COMPLETION_PROPOSAL, proposal_interface))

static void ladder_proposal_finalize(GObject *object)
{
	LadderProposal *proposal = LADDER_PROPOSAL(object);

	g_free(proposal->text);
	g_free(proposal->kind);
	g_free(proposal->note);
	g_free(proposal->key);
	G_OBJECT_CLASS(ladder_proposal_parent_class)->finalize(object);
}

static void ladder_proposal_class_init(LadderProposalClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_proposal_finalize;
}

static void ladder_proposal_init(LadderProposal *proposal)
{
	(void)proposal;
}

/* ---- all candidates ---- */

/* The order of candidates: words for this place alone first, words for any place last. */
static int rank_of(const struct ladder_word *word)
{
	static const struct {
		const char *kind;
		int rank;
	} ranks[] = {
		{ N_("pin"), 0 }, { N_("value"), 0 }, { N_("part of a number"), 0 },
		{ N_("part of a step"), 0 }, { N_("keyword"), 2 }, { N_("function"), 3 },
	};

	if (g_str_has_prefix(word->text, "SYS_"))
		return 4;
	for (gsize i = 0; i < G_N_ELEMENTS(ranks); i++)
		if (strcmp(ranks[i].kind, word->kind) == 0)
			return ranks[i].rank;
	return 1;
}

static void take_word(void *context, const struct ladder_word *word)
{
	LadderProposal *proposal = g_object_new(LADDER_TYPE_PROPOSAL, NULL);

	proposal->text = g_strdup(word->text);
	/* Bits of a number stay in their order: 9 before 10. */
	proposal->key = strcmp(word->kind, "part of a number") == 0 ?
		g_strdup_printf("%03u", g_list_model_get_n_items(context)) : name_fold(word->text);
	proposal->rank = rank_of(word);
	proposal->skeleton = strcmp(word->kind, "keyword") == 0 && st_skeleton_is(word->text);
	proposal->kind = g_strdup(_(word->kind));
	proposal->note = g_strdup(word->note[0] ? _(word->note) : "");
	g_list_store_append(context, proposal);
	g_object_unref(proposal);
}

static int by_key(gconstpointer a, gconstpointer b, gpointer unused)
{
	const LadderProposal *one = a, *other = b;

	(void)unused;
	return one->rank != other->rank ? one->rank - other->rank : strcmp(one->key, other->key);
}

/* The file with @text as the POU; @line becomes a line of the file. */
static char *whole_text(LadderDocument *document, int pou, const char *text, int *line)
{
	struct text_span span;
	char *outline, *whole;

	if (pou < 0)
		return g_strdup(text);
	outline = ladder_document_pou(document, pou, &span);
	if (!outline)
		return g_strdup(text);
	for (gsize i = 0; i < span.at; i++)
		*line += outline[i] == '\n';
	whole = g_strdup_printf("%.*s%s%s", (int)span.at, outline, text,
				outline + span.at + span.len);
	g_free(outline);
	return whole;
}

char *text_complete_call(LadderDocument *document, int pou, const char *text, int line,
			 int column)
{
	struct ladder *checked = ladder_document_checked(document);
	char *whole = whole_text(document, pou, text, &line), *call, *part[3], *marked;
	gsize from, to;

	call = checked ? ladder_call_at(checked, whole, strlen(whole), line + 1, column + 1, &from,
					&to) : NULL;
	g_free(whole);
	if (!call)
		return NULL;
	part[0] = g_markup_escape_text(call, (gssize)from);
	part[1] = g_markup_escape_text(call + from, (gssize)(to - from));
	part[2] = g_markup_escape_text(call + to, -1);
	marked = g_strdup_printf("%s<b>%s</b>%s", part[0], part[1], part[2]);
	for (gsize i = 0; i < G_N_ELEMENTS(part); i++)
		g_free(part[i]);
	free(call);
	return marked;
}

GListStore *text_complete_words(LadderDocument *document, int pou, const char *text,
				int line, int column, gsize *prefix_len)
{
	GListStore *words = g_list_store_new(LADDER_TYPE_PROPOSAL);
	struct ladder *checked = ladder_document_checked(document);
	struct ladder_place place = { 0 };
	char *whole = whole_text(document, pou, text, &line);

	if (!checked || !ladder_complete(checked, whole, strlen(whole), line + 1,
					 column + 1, take_word, words, &place))
		g_list_store_remove_all(words);
	g_list_store_sort(words, by_key, NULL);
	*prefix_len = place.prefix_len;
	g_free(whole);
	return words;
}

/* ---- the provider ---- */

#define LADDER_TYPE_WORDS (ladder_words_get_type())
G_DECLARE_FINAL_TYPE(LadderWords, ladder_words, LADDER, WORDS, GObject)

struct _LadderWords {
	GObject parent;
	LadderDocument *document;
	const int *pou;
	const struct text_range *part;
	GtkSourceView *view; /* holds the completion, which holds this          */
};

static char *text_of_buffer(GtkTextBuffer *buffer, int *line, int *column)
{
	GtkTextIter start, end, at;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	*line = gtk_text_iter_get_line(&at);
	*column = gtk_text_iter_get_line_index(&at);
	return gtk_text_buffer_get_text(buffer, &start, &end, TRUE);
}

/* A complete word is not offered: Enter then ends the line. The statement that begins with it is. */
static bool is_whole(GListStore *found, const char *prefix, gsize len)
{
	for (guint i = 0; i < g_list_model_get_n_items(G_LIST_MODEL(found)); i++) {
		LadderProposal *word = g_list_model_get_item(G_LIST_MODEL(found), i);

		g_object_unref(word); /* the list holds it */
		if (!word->skeleton && name_is(word->text, prefix, len))
			return true;
	}
	return false;
}

static const char *line_of(const char *text, int line)
{
	while (line-- > 0)
		text = strchr(text, '\n') + 1;
	return text;
}

/* Is the cursor behind a number? No word begins so, and a long text need not be looked at for each digit. */
static bool is_number(GtkTextBuffer *buffer)
{
	GtkTextIter at;
	gunichar first = 0, before;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	for (before = 0; gtk_text_iter_backward_char(&at); first = before) {
		before = gtk_text_iter_get_char(&at);
		if (!g_unichar_isalnum(before) && before != '_')
			break;
	}
	return first < 128 && ascii_digit((char)first) && before != '%' && before != '#' && before != '.';
}

static GListStore *words_here(LadderWords *words, gsize *prefix_len)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(words->view));
	int line, column;
	char *text, *list;
	GListStore *found;

	*prefix_len = 0;
	if (is_number(buffer))
		return g_list_store_new(LADDER_TYPE_PROPOSAL);
	text = text_of_buffer(buffer, &line, &column);
	list = text_range_whole(words->part, text);
	found = text_complete_words(words->document, *words->pou, list, words->part->lines + line, column,
				    prefix_len);
	if (*prefix_len && is_whole(found, line_of(text, line) + column - *prefix_len,
				    *prefix_len))
		g_list_store_remove_all(found);
	g_free(list);
	g_free(text);
	return found;
}

static char *get_title(GtkSourceCompletionProvider *provider)
{
	(void)provider;
	return g_strdup("Rungboard");
}

static void populate_async(GtkSourceCompletionProvider *provider,
			   GtkSourceCompletionContext *context, GCancellable *cancellable,
			   GAsyncReadyCallback callback, gpointer data)
{
	GTask *task = g_task_new(provider, cancellable, callback, data);
	gsize prefix_len;

	(void)context;
	g_task_return_pointer(task, words_here(LADDER_WORDS(provider), &prefix_len),
			      g_object_unref);
	g_object_unref(task);
}

/* GTK 4.8 and GtkSourceView 5.6 place the list beside the cursor, and fail if that is off the screen. */
static bool is_seen(GtkTextView *view)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(view);
	GdkRectangle seen, cursor;
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	gtk_text_view_get_iter_location(view, &at, &cursor);
	gtk_text_view_get_visible_rect(view, &seen);
	return gtk_widget_get_mapped(GTK_WIDGET(view)) && cursor.y < seen.y + seen.height &&
	       cursor.y + cursor.height > seen.y && cursor.x >= seen.x && cursor.x <= seen.x + seen.width;
}

/* The text may have been scrolled or hidden since the words were asked for. */
static GListModel *populate_finish(GtkSourceCompletionProvider *provider,
				   GAsyncResult *result, GError **error)
{
	GListModel *words = g_task_propagate_pointer(G_TASK(result), error);

	if (words && (!LADDER_WORDS(provider)->view || !is_seen(GTK_TEXT_VIEW(LADDER_WORDS(provider)->view))))
		g_list_store_remove_all(G_LIST_STORE(words));
	return words;
}

/* Each letter asks the engine again. */
static void refilter(GtkSourceCompletionProvider *provider,
		     GtkSourceCompletionContext *context, GListModel *model)
{
	gsize prefix_len;
	GListStore *now = words_here(LADDER_WORDS(provider), &prefix_len);

	(void)model;
	gtk_source_completion_context_set_proposals_for_provider(context, provider,
								 G_LIST_MODEL(now));
	g_object_unref(now);
}

static void display(GtkSourceCompletionProvider *provider,
		    GtkSourceCompletionContext *context,
		    GtkSourceCompletionProposal *proposal, GtkSourceCompletionCell *cell)
{
	const LadderProposal *word = LADDER_PROPOSAL(proposal);

	(void)provider;
	(void)context;
	switch (gtk_source_completion_cell_get_column(cell)) {
	case GTK_SOURCE_COMPLETION_COLUMN_TYPED_TEXT:
		gtk_source_completion_cell_set_text(cell, word->text);
		break;
	case GTK_SOURCE_COMPLETION_COLUMN_AFTER:
		gtk_source_completion_cell_set_text(cell,
			word->skeleton ? _("whole statement") :
			word->note[0] ? word->note : word->kind);
		break;
	case GTK_SOURCE_COMPLETION_COLUMN_ICON:
	case GTK_SOURCE_COMPLETION_COLUMN_BEFORE:
	case GTK_SOURCE_COMPLETION_COLUMN_COMMENT:
	case GTK_SOURCE_COMPLETION_COLUMN_DETAILS:
	default:
		break;
	}
}

/* Replaces the typed beginning by the word. */
static void activate(GtkSourceCompletionProvider *provider,
		     GtkSourceCompletionContext *context,
		     GtkSourceCompletionProposal *proposal)
{
	LadderWords *words = LADDER_WORDS(provider);
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(words->view));
	const char *text = LADDER_PROPOSAL(proposal)->text;
	GtkTextIter start, end;
	gsize prefix_len;

	(void)context;
	g_object_ref(proposal);
	g_object_unref(words_here(words, &prefix_len));
	gtk_text_buffer_get_iter_at_mark(buffer, &end, gtk_text_buffer_get_insert(buffer));
	start = end;
	gtk_text_iter_set_line_index(&start, gtk_text_iter_get_line_index(&end) -
				     (int)prefix_len);
	gtk_text_buffer_begin_user_action(buffer);
	gtk_text_buffer_delete(buffer, &start, &end);
	if (LADDER_PROPOSAL(proposal)->skeleton)
		st_skeleton_put(words->view, &start, text);
	else
		gtk_text_buffer_insert(buffer, &start, text, -1);
	gtk_text_buffer_end_user_action(buffer);
	g_object_unref(proposal);
}

static gboolean is_trigger(GtkSourceCompletionProvider *provider, const GtkTextIter *at,
			   gunichar c)
{
	(void)provider;
	(void)at;
	return c == '.' || c == '%' || c == '#';
}

static void provider_interface(GtkSourceCompletionProviderInterface *interface)
{
	interface->get_title = get_title;
	interface->populate_async = populate_async;
	interface->populate_finish = populate_finish;
	interface->refilter = refilter;
	interface->display = display;
	interface->activate = activate;
	interface->is_trigger = is_trigger;
}

G_DEFINE_FINAL_TYPE_WITH_CODE(LadderWords, ladder_words, G_TYPE_OBJECT,
	G_IMPLEMENT_INTERFACE(GTK_SOURCE_TYPE_COMPLETION_PROVIDER, provider_interface))

static void ladder_words_finalize(GObject *object)
{
	g_clear_weak_pointer(&LADDER_WORDS(object)->view);
	g_object_unref(LADDER_WORDS(object)->document);
	G_OBJECT_CLASS(ladder_words_parent_class)->finalize(object);
}

static void ladder_words_class_init(LadderWordsClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_words_finalize;
}

static void ladder_words_init(LadderWords *words)
{
	(void)words;
}

void text_complete_attach(GtkSourceView *view, LadderDocument *document, const int *pou,
			  const struct text_range *part)
{
	LadderWords *words = g_object_new(LADDER_TYPE_WORDS, NULL);

	words->document = g_object_ref(document);
	words->pou = pou;
	words->part = part;
	g_set_weak_pointer(&words->view, view);
	g_object_set(gtk_source_view_get_completion(view), "select-on-show", TRUE, NULL);
	gtk_source_completion_add_provider(gtk_source_view_get_completion(view),
					   GTK_SOURCE_COMPLETION_PROVIDER(words));
	g_object_unref(words);
}
