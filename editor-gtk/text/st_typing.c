/* SPDX-License-Identifier: MIT
 *
 * st_typing - statements that appear whole, lines that indent themselves; see st_typing.h.
 */
#include "editor-gtk/text/st_typing.h"

#include "engine/base/ascii.h"

#include <string.h>

#define STEP 2 /* blanks of a block                                             */

/* ---- whole statements ---- */

#define PLACE '@'  /* to fill in                                                */
#define PLACES "places" /* of a view: GPtrArray of GtkTextMark, those that are empty */

static const struct {
	const char *word, *text;
} skeletons[] = {
	{ "IF", "IF @ THEN\n  @\nEND_IF;" },
	{ "CASE", "CASE @ OF\n  @:\n    @\nEND_CASE;" },
	{ "FOR", "FOR @ := @ TO @ DO\n  @\nEND_FOR;" },
	{ "WHILE", "WHILE @ DO\n  @\nEND_WHILE;" },
	{ "REPEAT", "REPEAT\n  @\nUNTIL @ END_REPEAT;" },
};

static const char *skeleton_text(const char *word)
{
	for (gsize i = 0; i < G_N_ELEMENTS(skeletons); i++)
		if (ascii_is(skeletons[i].word, word, strlen(word)))
			return skeletons[i].text;
	return NULL;
}

gboolean st_skeleton_is(const char *word)
{
	return skeleton_text(word) != NULL;
}

static void drop_place(gpointer data)
{
	GtkTextMark *place = data;

	if (!gtk_text_mark_get_deleted(place))
		gtk_text_buffer_delete_mark(gtk_text_mark_get_buffer(place), place);
	g_object_unref(place);
}

static void forget_places(GtkSourceView *view)
{
	g_object_set_data(G_OBJECT(view), PLACES, NULL);
}

/* Moves the cursor to the next empty place. */
static gboolean go_to_place(GtkSourceView *view)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(view));
	GPtrArray *places = g_object_get_data(G_OBJECT(view), PLACES);
	GtkTextIter at;

	if (!places || places->len == 0)
		return FALSE;
	gtk_text_buffer_get_iter_at_mark(buffer, &at, places->pdata[0]);
	gtk_text_buffer_place_cursor(buffer, &at);
	gtk_text_view_scroll_mark_onscreen(GTK_TEXT_VIEW(view), gtk_text_buffer_get_insert(buffer));
	g_ptr_array_remove_index(places, 0);
	return TRUE;
}

/* The blanks in front of the line of @at. */
static char *blanks_of(const GtkTextIter *at)
{
	GtkTextIter from = *at, to;

	gtk_text_iter_set_line_offset(&from, 0);
	to = from;
	while (gtk_text_iter_compare(&to, at) < 0 &&
	       (gtk_text_iter_get_char(&to) == ' ' || gtk_text_iter_get_char(&to) == '\t'))
		gtk_text_iter_forward_char(&to);
	return gtk_text_iter_get_slice(&from, &to);
}

void st_skeleton_put(GtkSourceView *view, GtkTextIter *at, const char *word)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(view));
	GPtrArray *places = g_ptr_array_new_with_free_func(drop_place);
	char *blanks = blanks_of(at);

	for (const char *text = skeleton_text(word); *text; text++) {
		if (*text == PLACE)
			g_ptr_array_add(places, g_object_ref(
				gtk_text_buffer_create_mark(buffer, NULL, at, TRUE)));
		else
			gtk_text_buffer_insert(buffer, at, text, 1);
		if (*text == '\n')
			gtk_text_buffer_insert(buffer, at, blanks, -1);
	}
	g_free(blanks);
	g_object_set_data_full(G_OBJECT(view), PLACES, places, (GDestroyNotify)g_ptr_array_unref);
	go_to_place(view);
}

/* Between the lines of the first and the last place that is still empty? */
static gboolean is_near(GtkSourceView *view)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(view));
	GPtrArray *places = g_object_get_data(G_OBJECT(view), PLACES);
	GtkTextIter at, last;

	if (!places || places->len == 0)
		return FALSE;
	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	gtk_text_buffer_get_iter_at_mark(buffer, &last, places->pdata[places->len - 1]);
	return ABS(gtk_text_iter_get_line(&at) - gtk_text_iter_get_line(&last)) <= 3;
}

static gboolean pressed(GtkEventController *keys, guint key, guint code, GdkModifierType state,
			gpointer unused)
{
	GtkSourceView *view = GTK_SOURCE_VIEW(gtk_event_controller_get_widget(keys));

	(void)code;
	(void)unused;
	if (key == GDK_KEY_Escape)
		forget_places(view);
	if (key != GDK_KEY_Tab || state & (GDK_SHIFT_MASK | GDK_CONTROL_MASK | GDK_ALT_MASK))
		return GDK_EVENT_PROPAGATE;
	if (is_near(view))
		return go_to_place(view);
	forget_places(view);
	return GDK_EVENT_PROPAGATE;
}

/* ---- lines ---- */

/* A line without its comments and strings. */
struct line {
	int blanks;          /* in front of it                                 */
	char first[16], last[16]; /* its words, in capitals; ":" and ";" count as words */
	int depth;           /* blocks that it opens, less those that it ends  */
};

static gboolean is_word(char c)
{
	return g_ascii_isalnum(c) || c == '_';
}

static gboolean is_any(const char *word, const char *const *words)
{
	return g_strv_contains((const gchar *const *)words, word);
}

static gboolean begins_block(const char *word)
{
	static const char *const words[] = { "IF", "CASE", "FOR", "WHILE", "REPEAT", NULL };

	return is_any(word, words);
}

static void keep_word(struct line *line, const char *word, gsize len)
{
	char kept[16];

	if (len >= sizeof(kept))
		len = sizeof(kept) - 1;
	memcpy(kept, word, len);
	kept[len] = '\0';
	for (gsize i = 0; i < len; i++)
		kept[i] = ascii_upper(kept[i]);
	g_strlcpy(line->last, kept, sizeof(line->last));
	line->depth += begins_block(kept);
	line->depth -= g_str_has_prefix(kept, "END_") && begins_block(kept + 4);
	if (!line->first[0])
		g_strlcpy(line->first, kept, sizeof(line->first));
}

/* Behind a comment or string at @at; @at: none begins there. */
static const char *behind(const char *at)
{
	const char *end = at;

	if (g_str_has_prefix(at, "//"))
		return strchr(at, '\n') ? strchr(at, '\n') : at + strlen(at);
	if (g_str_has_prefix(at, "(*")) {
		end = strstr(at + 2, "*)");
		return end ? end + 2 : at + strlen(at);
	}
	if (*at != '\'' && *at != '"')
		return at;
	for (end = at + 1; *end && *end != '\n' && *end != *at; end++)
		end += *end == '$' && end[1] && end[1] != '\n';
	return *end == *at ? end + 1 : end;
}

static struct line read_line(const char *text)
{
	struct line line = { 0 };
	const char *at = text;

	for (; *at == ' ' || *at == '\t'; at++)
		line.blanks += *at == '\t' ? 8 - line.blanks % 8 : 1;
	while (*at && *at != '\n') {
		const char *next = behind(at);

		if (next == at && is_word(*at)) {
			while (is_word(*next))
				next++;
			keep_word(&line, at, (gsize)(next - at));
		} else if (next == at) {
			next++;
			if (*at != ' ' && *at != '\t' && *at != '\r')
				keep_word(&line, at, *at == ':' && *next == '=' ? 2 : 1);
			next += *at == ':' && *next == '=';
		} else if (*at == '\'' || *at == '"') {
			keep_word(&line, at, 1);
		}
		at = next;
	}
	return line;
}

static gboolean closes(const char *word)
{
	static const char *const words[] = { "END_IF", "END_CASE", "END_FOR", "END_WHILE",
		"END_REPEAT", "ELSE", "ELSIF", "UNTIL", NULL };

	return is_any(word, words);
}

static gboolean opens(const struct line *line)
{
	static const char *const words[] = { "THEN", "DO", "OF", "ELSE", "REPEAT", ":", NULL };

	return is_any(line->last, words) && !g_str_has_prefix(line->first, "VAR");
}

static gboolean is_head(const char *word)
{
	static const char *const words[] = { "PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "SUBROUTINE",
		"END_VAR", NULL };

	return is_any(word, words);
}

static const char *text_of(const char *text, int line)
{
	while (line-- > 0 && text)
		text = strchr(text, '\n') ? strchr(text, '\n') + 1 : NULL;
	return text ? text : "";
}

/* The line that opened the block which @word, in line @line, ends or goes on with; STEP of the body
 * if there is none. */
static int indent_of_block(const char *text, int line)
{
	int open = 1;

	while (--line >= 0) {
		const struct line one = read_line(text_of(text, line));

		open -= one.depth;
		if (open <= 0)
			return one.blanks;
		if (is_head(one.first))
			break;
	}
	return STEP;
}

int st_indent(const char *text, int line)
{
	const struct line own = read_line(text_of(text, line));

	if (closes(own.first))
		return indent_of_block(text, line);
	while (--line >= 0) {
		const struct line above = read_line(text_of(text, line));

		if (!above.last[0])
			continue;
		if (is_head(above.first))
			return STEP;
		return above.blanks + (opens(&above) ? STEP : 0);
	}
	return 0;
}

/* ---- the indenter ---- */

#define LADDER_TYPE_ST_INDENTER (ladder_st_indenter_get_type())
G_DECLARE_FINAL_TYPE(LadderStIndenter, ladder_st_indenter, LADDER, ST_INDENTER, GObject)

struct _LadderStIndenter {
	GObject parent;
};

static gboolean is_trigger(GtkSourceIndenter *indenter, GtkSourceView *view,
			   const GtkTextIter *at, GdkModifierType state, guint key)
{
	(void)indenter;
	(void)view;
	(void)at;
	return !(state & (GDK_CONTROL_MASK | GDK_ALT_MASK)) &&
	       (key == GDK_KEY_Return || key == GDK_KEY_KP_Enter);
}

/* @at: in the line; goes along. */
static void indent_line(GtkTextBuffer *buffer, GtkTextIter *at)
{
	const int line = gtk_text_iter_get_line(at);
	GtkTextIter from, to;
	char *text, *blanks;
	int wanted, rest;

	gtk_text_buffer_get_bounds(buffer, &from, &to);
	text = gtk_text_buffer_get_text(buffer, &from, &to, TRUE);
	wanted = st_indent(text, line);
	g_free(text);
	gtk_text_buffer_get_iter_at_line(buffer, &from, line);
	to = from;
	while (gtk_text_iter_get_char(&to) == ' ' || gtk_text_iter_get_char(&to) == '\t')
		gtk_text_iter_forward_char(&to);
	rest = MAX(gtk_text_iter_get_line_offset(at) - gtk_text_iter_get_line_offset(&to), 0);
	if (gtk_text_iter_get_line_offset(&to) != wanted) {
		blanks = g_strnfill((gsize)wanted, ' ');
		gtk_text_buffer_delete(buffer, &from, &to);
		gtk_text_buffer_insert(buffer, &from, blanks, -1);
		g_free(blanks);
	}
	gtk_text_buffer_get_iter_at_line_offset(buffer, at, line, wanted + rest);
}

static void indent(GtkSourceIndenter *indenter, GtkSourceView *view, GtkTextIter *at)
{
	(void)indenter;
	indent_line(gtk_text_view_get_buffer(GTK_TEXT_VIEW(view)), at);
}

/* A word that was just typed moves its line, if it stands alone in it. */
static void typed(GtkTextBuffer *buffer)
{
	GtkTextIter from, at;
	char *text;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	if (!gtk_text_iter_ends_line(&at))
		return;
	from = at;
	gtk_text_iter_set_line_offset(&from, 0);
	text = g_strchug(gtk_text_iter_get_slice(&from, &at));
	for (char *c = text; *c; c++)
		*c = ascii_upper(*c);
	if (closes(text))
		indent_line(buffer, &at);
	g_free(text);
}

static void indenter_interface(GtkSourceIndenterInterface *interface)
{
	interface->is_trigger = is_trigger;
	interface->indent = indent;
}

G_DEFINE_FINAL_TYPE_WITH_CODE(LadderStIndenter, ladder_st_indenter, G_TYPE_OBJECT,
	G_IMPLEMENT_INTERFACE(GTK_SOURCE_TYPE_INDENTER, indenter_interface))

static void ladder_st_indenter_class_init(LadderStIndenterClass *class)
{
	(void)class;
}

static void ladder_st_indenter_init(LadderStIndenter *indenter)
{
	(void)indenter;
}

/* Once in the life of a view. */
static void listen_to_tab(GtkSourceView *view)
{
	GtkEventController *keys;

	if (g_object_get_data(G_OBJECT(view), "tab"))
		return;
	g_object_set_data(G_OBJECT(view), "tab", view);
	keys = gtk_event_controller_key_new();
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(pressed), NULL);
	gtk_widget_add_controller(GTK_WIDGET(view), keys);
}

void st_typing_set(GtkSourceView *view, gboolean on)
{
	GtkSourceIndenter *indenter = on ? g_object_new(LADDER_TYPE_ST_INDENTER, NULL) : NULL;

	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(view));

	if (on == (g_signal_handler_find(buffer, G_SIGNAL_MATCH_FUNC, 0, 0, NULL, typed, NULL) != 0)) {
		g_clear_object(&indenter);
		return;
	}
	g_signal_handlers_disconnect_by_func(buffer, typed, NULL);
	if (on) {
		g_signal_connect(buffer, "end-user-action", G_CALLBACK(typed), NULL);
		listen_to_tab(view);
	}
	gtk_source_view_set_indenter(view, indenter);
	gtk_source_view_set_insert_spaces_instead_of_tabs(view, on);
	gtk_source_view_set_indent_width(view, on ? STEP : -1);
	g_clear_object(&indenter);
}
