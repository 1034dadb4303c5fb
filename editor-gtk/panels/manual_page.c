/* SPDX-License-Identifier: MIT
 *
 * manual_page - see manual_page.h.
 */
#include "editor-gtk/panels/manual_page.h"

#include "editor-gtk/kit/theme.h"

#define WIDTH_MOST 860 /* px of a line of text                                  */
#define MARGIN     24  /* px beside the text, at least                          */
#define DEEPER     24  /* px for each level of lists                            */
#define HANG       20  /* px from the mark of an item to its text               */
#define PRE_HANGS  24  /* px of the second line of code that is too long          */
#define LINK "link"    /* data of a tag                                         */

static GtkTextBuffer *buffer_of(const struct manual_text *text)
{
	return gtk_text_view_get_buffer(text->view);
}

/* ---- tags ---- */

static void make_tags(GtkTextBuffer *buffer)
{
	static const double scale[] = { 1.6, 1.35, 1.15, 1.0 };

	for (int i = 0; i < (int)G_N_ELEMENTS(scale); i++) {
		char name[4] = { 'h', (char)('1' + i), '\0' };

		gtk_text_buffer_create_tag(buffer, name, "scale", scale[i], "weight",
			PANGO_WEIGHT_BOLD, "pixels-above-lines", i ? 14 : 0,
			"pixels-below-lines", 6, NULL);
	}
	gtk_text_buffer_create_tag(buffer, "text", "pixels-below-lines", 8,
				   "pixels-inside-wrap", 2, NULL);
	gtk_text_buffer_create_tag(buffer, "bold", "weight", PANGO_WEIGHT_BOLD, NULL);
	gtk_text_buffer_create_tag(buffer, "emphasis", "style", PANGO_STYLE_ITALIC, NULL);
	gtk_text_buffer_create_tag(buffer, "code", "family", "monospace", NULL);
	gtk_text_buffer_create_tag(buffer, "pre", "family", "monospace", "wrap-mode",
				   GTK_WRAP_WORD_CHAR, "indent", -PRE_HANGS, NULL);
}

/* As the theme has them now. */
static void colour_tags(GtkTextBuffer *buffer)
{
	GtkTextTagTable *table = gtk_text_buffer_get_tag_table(buffer);
	const struct theme *theme = theme_screen();

	g_object_set(gtk_text_tag_table_lookup(table, "pre"), "paragraph-background-rgba",
		     &theme->color[TOKEN_GUTTER], NULL);
}

static GtkTextTag *link_tag(GtkTextBuffer *buffer, const char *link)
{
	GtkTextTag *tag = gtk_text_buffer_create_tag(buffer, NULL, "foreground-rgba",
		&theme_screen()->color[TOKEN_ACCENT], "underline", PANGO_UNDERLINE_SINGLE,
		NULL);

	g_object_set_data_full(G_OBJECT(tag), LINK, g_strdup(link), g_free);
	return tag;
}

static gboolean is_of_link(GtkTextTag *tag)
{
	return g_object_get_data(G_OBJECT(tag), LINK) != NULL;
}

static void forget_tag(GtkTextTag *tag, gpointer all)
{
	if (is_of_link(tag))
		g_ptr_array_add(all, tag);
}

/* Removes the tags that the links of the page before had. */
static void forget_links(GtkTextBuffer *buffer)
{
	GtkTextTagTable *table = gtk_text_buffer_get_tag_table(buffer);
	GPtrArray *all = g_ptr_array_new();

	gtk_text_tag_table_foreach(table, forget_tag, all);
	for (guint i = 0; i < all->len; i++)
		gtk_text_tag_table_remove(table, all->pdata[i]);
	g_ptr_array_unref(all);
}

/* ---- text ---- */

static int end_of(GtkTextBuffer *buffer)
{
	return gtk_text_buffer_get_char_count(buffer);
}

static void apply(GtkTextBuffer *buffer, GtkTextTag *tag, int from)
{
	GtkTextIter begin, end;

	gtk_text_buffer_get_iter_at_offset(buffer, &begin, from);
	gtk_text_buffer_get_end_iter(buffer, &end);
	gtk_text_buffer_apply_tag(buffer, tag, &begin, &end);
}

static void apply_name(GtkTextBuffer *buffer, const char *name, int from)
{
	apply(buffer, gtk_text_tag_table_lookup(gtk_text_buffer_get_tag_table(buffer), name),
	      from);
}

static void put(GtkTextBuffer *buffer, const char *text)
{
	GtkTextIter end;

	gtk_text_buffer_get_end_iter(buffer, &end);
	gtk_text_buffer_insert(buffer, &end, text, -1);
}

static void put_runs(GtkTextBuffer *buffer, const GArray *runs)
{
	static const struct { unsigned int style; const char *tag; } styles[] = {
		{ MD_BOLD, "bold" }, { MD_EMPHASIS, "emphasis" }, { MD_CODE, "code" },
	};

	for (guint i = 0; i < runs->len; i++) {
		const struct md_run *run = &g_array_index(runs, struct md_run, i);
		const int from = end_of(buffer);

		put(buffer, run->text);
		for (gsize k = 0; k < G_N_ELEMENTS(styles); k++)
			if (run->style & styles[k].style)
				apply_name(buffer, styles[k].tag, from);
		if (run->link)
			apply(buffer, link_tag(buffer, run->link), from);
	}
}

/* Moves the text from @from on to the right, @hang px less in its first line. */
static void indent(GtkTextBuffer *buffer, int level, bool hang, int from)
{
	char name[24];
	PangoTabArray *tabs;
	GtkTextTag *tag;

	if (!level)
		return;
	tabs = pango_tab_array_new_with_positions(1, TRUE, PANGO_TAB_LEFT, HANG);
	g_snprintf(name, sizeof(name), "%s %d", hang ? "item" : "deeper", level);
	tag = gtk_text_tag_table_lookup(gtk_text_buffer_get_tag_table(buffer), name);
	if (!tag)
		tag = gtk_text_buffer_create_tag(buffer, name, "accumulative-margin", TRUE,
			"left-margin", level * DEEPER, "indent", hang ? -HANG : 0,
			"tabs", tabs, NULL);
	apply(buffer, tag, from);
	pango_tab_array_free(tabs);
}

/* ---- tables and pictures ---- */

static char *markup_of(const GArray *runs, bool heading)
{
	GString *markup = g_string_new(heading ? "<b>" : "");

	for (guint i = 0; i < runs->len; i++) {
		const struct md_run *run = &g_array_index(runs, struct md_run, i);
		char *text = g_markup_escape_text(run->text, -1);
		char *link = run->link ? g_markup_printf_escaped("<a href=\"%s\">", run->link) :
					 g_strdup("");

		g_string_append_printf(markup, "%s%s%s%s%s%s%s%s%s", link,
			run->style & MD_BOLD ? "<b>" : "",
			run->style & MD_EMPHASIS ? "<i>" : "",
			run->style & MD_CODE ? "<tt>" : "", text,
			run->style & MD_CODE ? "</tt>" : "",
			run->style & MD_EMPHASIS ? "</i>" : "",
			run->style & MD_BOLD ? "</b>" : "", run->link ? "</a>" : "");
		g_free(link);
		g_free(text);
	}
	g_string_append(markup, heading ? "</b>" : "");
	return g_string_free(markup, FALSE);
}

static GtkWidget *cell_new(const GArray *runs, bool heading)
{
	GtkWidget *label = gtk_label_new(NULL);
	char *markup = markup_of(runs, heading);

	gtk_label_set_markup(GTK_LABEL(label), markup);
	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_yalign(GTK_LABEL(label), 0);
	gtk_label_set_wrap(GTK_LABEL(label), TRUE);
	gtk_label_set_wrap_mode(GTK_LABEL(label), PANGO_WRAP_WORD_CHAR);
	gtk_label_set_selectable(GTK_LABEL(label), TRUE);
	gtk_widget_set_hexpand(label, TRUE);
	g_free(markup);
	return label;
}

static GtkWidget *table_new(const struct md_block *block,
			    gboolean (*follow)(GtkLabel *, const char *, gpointer),
			    gpointer data)
{
	GtkWidget *grid = gtk_grid_new();

	gtk_widget_add_css_class(grid, "manual-table");
	for (guint i = 0; i < block->cells->len; i++) {
		GtkWidget *cell = cell_new(block->cells->pdata[i],
					   (int)i < block->columns);

		g_signal_connect(cell, "activate-link", G_CALLBACK(follow), data);
		gtk_grid_attach(GTK_GRID(grid), cell, (int)i % block->columns,
				(int)i / block->columns, 1, 1);
	}
	return grid;
}

static GtkWidget *picture_new(const struct md_block *block, const char *folder)
{
	char *path = g_build_filename(folder, block->file, NULL);
	char *instead = markdown_runs_text(block->runs);
	GtkWidget *picture = gtk_picture_new_for_filename(path);

	gtk_picture_set_alternative_text(GTK_PICTURE(picture), instead);
	gtk_picture_set_can_shrink(GTK_PICTURE(picture), TRUE);
	gtk_widget_set_halign(picture, GTK_ALIGN_START);
	g_free(instead);
	g_free(path);
	return picture;
}

static void put_widget(struct manual_text *text, GtkWidget *widget)
{
	GtkTextBuffer *buffer = buffer_of(text);
	GtkTextChildAnchor *anchor;
	GtkTextIter end;

	gtk_text_buffer_get_end_iter(buffer, &end);
	anchor = gtk_text_buffer_create_child_anchor(buffer, &end);
	gtk_text_view_add_child_at_anchor(text->view, widget, anchor);
}

/* ---- a page ---- */

/* GTK draws no background for a line without characters: it gets a blank. */
static void put_code(GtkTextBuffer *buffer, const struct md_block *block)
{
	char *code = markdown_runs_text(block->runs);
	GString *text = g_string_new(code);

	g_string_replace(text, "\n\n", "\n \n", 0);
	put(buffer, text->str);
	g_string_free(text, TRUE);
	g_free(code);
}

static void put_block(struct manual_text *text, const struct md_block *block)
{
	GtkTextBuffer *buffer = buffer_of(text);
	const int from = end_of(buffer);
	char name[4] = { 'h', (char)('0' + CLAMP(block->level, 1, 4)), '\0' };

	if (block->mark) {
		put(buffer, block->mark);
		put(buffer, "\t");
	}
	if (block->kind == MD_CODE_BLOCK) { /* it ends with a line end           */
		put_code(buffer, block);
		apply_name(buffer, "pre", from);
		indent(buffer, block->level, false, from);
		put(buffer, "\n");
		return;
	}
	put_runs(buffer, block->runs);
	put(buffer, "\n");
	apply_name(buffer, block->kind == MD_HEADING ? name : "text", from);
	if (block->kind == MD_TEXT)
		indent(buffer, block->level, block->mark != NULL, from);
}

static void put_inside(struct manual_text *text, GtkWidget *widget, int level)
{
	GtkTextBuffer *buffer = buffer_of(text);
	const int from = end_of(buffer);

	put_widget(text, widget);
	put(buffer, "\n");
	apply_name(buffer, "text", from);
	indent(buffer, level, false, from);
}

/* Before their text: GTK 4.8 ends with a wrong access when deleting text unmaps a widget. */
static void remove_widgets(struct manual_text *text)
{
	for (guint i = 0; i < text->start->len; i++) {
		GtkWidget *table = text->tables->pdata[i], *picture = text->pictures->pdata[i];

		if (table || picture)
			gtk_text_view_remove(text->view, table ? table : picture);
	}
}

void manual_text_show(struct manual_text *text, const struct md_page *page, const char *folder,
		      gboolean (*follow)(GtkLabel *label, const char *link, gpointer data),
		      gpointer data)
{
	GtkTextBuffer *buffer = buffer_of(text);

	remove_widgets(text);
	text->page = page;
	g_array_set_size(text->start, 0);
	g_ptr_array_set_size(text->tables, 0);
	g_ptr_array_set_size(text->pictures, 0);
	gtk_text_buffer_set_text(buffer, "", -1);
	forget_links(buffer);
	colour_tags(buffer);
	for (guint i = 0; i < page->blocks->len; i++) {
		const struct md_block *block = page->blocks->pdata[i];
		const int start = end_of(buffer);
		GtkWidget *table = block->kind == MD_TABLE ? table_new(block, follow, data) :
							     NULL;
		GtkWidget *picture = block->kind == MD_PICTURE ? picture_new(block, folder) :
								 NULL;

		g_array_append_val(text->start, start);
		g_ptr_array_add(text->tables, table);
		g_ptr_array_add(text->pictures, picture);
		if (table || picture)
			put_inside(text, table ? table : picture, block->level);
		else
			put_block(text, block);
	}
	text->width = 0;
	manual_text_fit(text);
}

/* A picture is never larger than it is. */
static void fit_picture(GtkPicture *picture, int width)
{
	GdkPaintable *paintable = gtk_picture_get_paintable(picture);
	const int wide = paintable ? gdk_paintable_get_intrinsic_width(paintable) : 0;
	const int high = paintable ? gdk_paintable_get_intrinsic_height(paintable) : 0;
	const int to = MIN(width, wide);

	if (wide > 0)
		gtk_widget_set_size_request(GTK_WIDGET(picture), to,
					    (int)((gint64)high * to / wide));
}

void manual_text_fit(struct manual_text *text)
{
	const int all = gtk_widget_get_width(GTK_WIDGET(text->view));
	const int margin = MAX(MARGIN, (all - WIDTH_MOST) / 2);
	const int width = all - 2 * margin;

	if (width <= 0 || width == text->width)
		return;
	text->width = width;
	gtk_text_view_set_left_margin(text->view, margin);
	gtk_text_view_set_right_margin(text->view, margin);
	for (guint i = 0; i < text->tables->len; i++)
		if (text->tables->pdata[i])
			gtk_widget_set_size_request(text->tables->pdata[i], width, -1);
	for (guint i = 0; i < text->pictures->len; i++)
		if (text->pictures->pdata[i])
			fit_picture(text->pictures->pdata[i], width - 2 * DEEPER);
}

/* ---- copying ---- */

int manual_text_block(const struct manual_text *text, const GtkTextIter *at)
{
	const int offset = gtk_text_iter_get_offset(at);
	int block = (int)text->start->len - 1;

	while (block >= 0 && g_array_index(text->start, int, block) > offset)
		block--;
	return block;
}

char *manual_text_block_copy(const struct manual_text *text, int block)
{
	return markdown_block_text(text->page->blocks->pdata[block]);
}

#define WIDGET 0xfffc /* what the text has in the place of a widget             */

static void append_widget(const struct manual_text *text, const GtkTextIter *at, GString *out)
{
	char *instead = manual_text_block_copy(text, manual_text_block(text, at));

	g_string_append(out, g_strchomp(instead));
	g_free(instead);
}

/* A blank line of code has a blank, see put_code(). */
static bool is_made_blank(const struct manual_text *text, const GtkTextIter *at)
{
	const int block = manual_text_block(text, at);
	GtkTextIter next = *at;

	if (gtk_text_iter_get_char(at) != ' ' || !gtk_text_iter_starts_line(at) || block < 0 ||
	    ((struct md_block *)text->page->blocks->pdata[block])->kind != MD_CODE_BLOCK)
		return false;
	gtk_text_iter_forward_char(&next);
	return gtk_text_iter_ends_line(&next);
}

char *manual_text_copy(const struct manual_text *text, const GtkTextIter *from,
		       const GtkTextIter *to)
{
	GString *out = g_string_new(NULL);
	GtkTextIter at = *from;

	for (; gtk_text_iter_compare(&at, to) < 0; gtk_text_iter_forward_char(&at)) {
		if (gtk_text_iter_get_char(&at) == WIDGET)
			append_widget(text, &at, out);
		else if (!is_made_blank(text, &at))
			g_string_append_unichar(out, gtk_text_iter_get_char(&at));
	}
	return g_string_free(out, FALSE);
}

/* ---- links ---- */

static GtkTextTag *tag_at(const GtkTextIter *at)
{
	GSList *tags = gtk_text_iter_get_tags(at);
	GtkTextTag *found = NULL;

	for (GSList *each = tags; each && !found; each = each->next)
		if (is_of_link(each->data))
			found = each->data;
	g_slist_free(tags);
	return found;
}

const char *manual_text_link(const GtkTextIter *at)
{
	GtkTextTag *tag = tag_at(at);

	return tag ? g_object_get_data(G_OBJECT(tag), LINK) : NULL;
}

bool manual_text_next_link(GtkTextIter *at, GtkTextIter *end, bool back)
{
	GtkTextTag *here = tag_at(at);
	GtkTextTag *tag = NULL;

	while (!tag && (back ? gtk_text_iter_backward_to_tag_toggle(at, NULL) :
			       gtk_text_iter_forward_to_tag_toggle(at, NULL)))
		if (tag_at(at) && tag_at(at) != here)
			tag = tag_at(at);
	if (!tag)
		return false;
	if (!gtk_text_iter_starts_tag(at, tag))
		gtk_text_iter_backward_to_tag_toggle(at, tag);
	*end = *at;
	gtk_text_iter_forward_to_tag_toggle(end, tag);
	return true;
}

/* ---- life ---- */

void manual_text_init(struct manual_text *text, GtkTextView *view)
{
	*text = (struct manual_text){ .view = view,
		.start = g_array_new(FALSE, FALSE, sizeof(int)),
		.tables = g_ptr_array_new(), .pictures = g_ptr_array_new() };
	gtk_text_view_set_left_margin(view, MARGIN); /* until the width is known */
	gtk_text_view_set_right_margin(view, MARGIN);
	make_tags(buffer_of(text));
}

void manual_text_clear(struct manual_text *text)
{
	g_clear_pointer(&text->start, g_array_unref);
	g_clear_pointer(&text->tables, g_ptr_array_unref);
	g_clear_pointer(&text->pictures, g_ptr_array_unref);
}
