/* SPDX-License-Identifier: MIT
 *
 * welcome - the page of an editor without a file; see welcome.h.
 */
#include "editor-gtk/window/welcome.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/plain_file.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/installed.h"
#include "editor-gtk/kit/theme.h"
#include "editor-gtk/render/render_sheet.h"
#include "editor-gtk/window/recent.h"

#include "engine/base/limits.h"

#include <adwaita.h>
#include <string.h>

/* The folder of the samples; NULL: none. Caller frees. */
static char *samples_folder(void)
{
	const char *told = g_getenv("RUNGBOARD_LADDERS");
	char *found = told ? g_strdup(told) : installed_folder("ladders", "rungboard/ladders");
	char *samples = found ? g_canonicalize_filename(found, NULL) : NULL;

	g_free(found);
	return samples;
}

/* ---- rows ---- */

static void activated(AdwActionRow *row)
{
	const char *action = g_object_get_data(G_OBJECT(row), "action");
	const char *path = g_object_get_data(G_OBJECT(row), "path");

	if (path)
		gtk_widget_activate_action(GTK_WIDGET(row), action, "s", path);
	else
		gtk_widget_activate_action(GTK_WIDGET(row), action, NULL);
}

static void add_row(GtkWidget *group, const char *title, const char *subtitle,
		    const char *action, const char *path)
{
	GtkWidget *row = adw_action_row_new();
	char *escaped = g_markup_escape_text(title, -1);
	char *below = subtitle ? g_markup_escape_text(subtitle, -1) : NULL;

	adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), escaped);
	if (below)
		adw_action_row_set_subtitle(ADW_ACTION_ROW(row), below);
	gtk_list_box_row_set_activatable(GTK_LIST_BOX_ROW(row), TRUE);
	g_object_set_data_full(G_OBJECT(row), "action", g_strdup(action), g_free);
	g_object_set_data_full(G_OBJECT(row), "path", g_strdup(path), g_free);
	g_signal_connect(row, "activated", G_CALLBACK(activated), NULL);
	adw_preferences_group_add(ADW_PREFERENCES_GROUP(group), row);
	g_free(escaped);
	g_free(below);
}

#define ROWS_WIDE 600   /* px at most                                           */
#define CARDS_WIDE 1240

static GtkWidget *add_group(GtkWidget *groups, const char *title, int wide)
{
	GtkWidget *group = adw_preferences_group_new(), *clamp = adw_clamp_new();

	adw_preferences_group_set_title(ADW_PREFERENCES_GROUP(group), title);
	adw_clamp_set_maximum_size(ADW_CLAMP(clamp), wide);
	adw_clamp_set_tightening_threshold(ADW_CLAMP(clamp), wide);
	adw_clamp_set_child(ADW_CLAMP(clamp), group);
	gtk_box_append(GTK_BOX(groups), clamp);
	return group;
}

/* ---- what there is to open ---- */

static void add_recent(GtkWidget *groups)
{
	GPtrArray *paths = recent_paths();
	GtkWidget *group = paths->len ? add_group(groups, _("Recent"), ROWS_WIDE) : NULL;

	for (guint i = 0; i < paths->len; i++) {
		char *name = g_path_get_basename(paths->pdata[i]);

		add_row(group, name, paths->pdata[i], "win.open-path", paths->pdata[i]);
		g_free(name);
	}
	g_ptr_array_unref(paths);
}

/* ---- samples ---- */

#define FIRST_FILE "main.st" /* of a sample that is a folder                      */
#define CARD_WIDE 176 /* px of a card's picture                                 */
#define CARD_HIGH 104
#define CARD_SCALE 0.5f

/* The first program of a sample, its upper left part; drawn after the page is shown. */
#define LADDER_TYPE_SAMPLE (ladder_sample_get_type())
G_DECLARE_FINAL_TYPE(LadderSample, ladder_sample, LADDER, SAMPLE, GtkWidget)

struct _LadderSample {
	GtkWidget parent_instance;
	char *path;
	struct lettering *lettering;
	struct picture strokes;
	guint idle;             /* loads and draws it; 0: done                    */
};

G_DEFINE_FINAL_TYPE(LadderSample, ladder_sample, GTK_TYPE_WIDGET)

/* Reads a rung file, or a folder of plain IEC text. */
static bool load_sample(struct ladder *ladder, const char *path)
{
	gsize len = 0;
	char *text = g_file_test(path, G_FILE_TEST_IS_DIR) ? plain_file_import(path, &len) : NULL;
	const bool good = text ? ladder_load_text(ladder, g_intern_string(path), text, len) :
			  ladder_load(ladder, g_intern_string(path));

	g_free(text);
	return good;
}

static gboolean draw_sample(gpointer data)
{
	LadderSample *sample = data;
	const struct render_options options = { .scale = 1, .show = SHOW_SYMBOLS };
	struct ladder *ladder = ladder_new();

	sample->idle = 0;
	if (ladder && load_sample(ladder, sample->path) &&
	    ladder_project(ladder) && ladder_project(ladder)->pou_count > 0) {
		sample->lettering = lettering_new(gtk_widget_get_pango_context(
			GTK_WIDGET(sample)), NULL);
		render_sheets(ladder_project(ladder), 0, &options, sample->lettering,
			      &sample->strokes);
		gtk_widget_queue_draw(GTK_WIDGET(sample));
	}
	ladder_free(ladder);
	return G_SOURCE_REMOVE;
}

static void sample_snapshot(GtkWidget *widget, GtkSnapshot *shot)
{
	LadderSample *sample = LADDER_SAMPLE(widget);
	const graphene_rect_t all = GRAPHENE_RECT_INIT(0, 0,
		(float)gtk_widget_get_width(widget), (float)gtk_widget_get_height(widget));
	const struct theme *theme = theme_screen();

	gtk_snapshot_append_color(shot, &theme->color[TOKEN_SHEET], &all);
	gtk_snapshot_push_clip(shot, &all);
	gtk_snapshot_scale(shot, CARD_SCALE, CARD_SCALE);
	if (sample->lettering)
		picture_snapshot(&sample->strokes, theme, sample->lettering, shot);
	gtk_snapshot_pop(shot);
}

static void sample_dispose(GObject *object)
{
	LadderSample *sample = LADDER_SAMPLE(object);

	g_clear_handle_id(&sample->idle, g_source_remove);
	picture_clear(&sample->strokes);
	g_clear_pointer(&sample->lettering, lettering_free);
	g_clear_pointer(&sample->path, g_free);
	G_OBJECT_CLASS(ladder_sample_parent_class)->dispose(object);
}

static void ladder_sample_class_init(LadderSampleClass *class)
{
	G_OBJECT_CLASS(class)->dispose = sample_dispose;
	GTK_WIDGET_CLASS(class)->snapshot = sample_snapshot;
	gtk_widget_class_set_accessible_role(GTK_WIDGET_CLASS(class), GTK_ACCESSIBLE_ROLE_IMG);
}

static void ladder_sample_init(LadderSample *sample)
{
	picture_init(&sample->strokes);
	gtk_widget_set_size_request(GTK_WIDGET(sample), CARD_WIDE, CARD_HIGH);
}

static GtkWidget *sample_new(const char *path)
{
	LadderSample *sample = g_object_new(LADDER_TYPE_SAMPLE, NULL);

	sample->path = g_strdup(path);
	sample->idle = g_idle_add_full(G_PRIORITY_LOW, draw_sample, sample, NULL);
	return GTK_WIDGET(sample);
}

/* Title and description of a file: the text after PROJECT, and the first sentence of the first
 * comment that begins a line; others are of variables. NULL: nothing. */
struct about {
	char *title, *line;
};

/* A copy of @text up to one of @ends, with single blanks. NULL of NULL. Caller frees. */
static char *up_to(const char *text, const char *ends)
{
	char *part = text ? g_strndup(text, strcspn(text, ends)) : NULL;
	char **words = part ? g_strsplit_set(part, " \n", -1) : NULL;
	GString *line = g_string_new(NULL);

	for (char **word = words; word && *word; word++)
		if (**word)
			g_string_append_printf(line, "%s%s", line->len ? " " : "", *word);
	g_strfreev(words);
	g_free(part);
	return g_string_free(line, line->len == 0);
}

static struct about about_of(const char *path)
{
	static const char head[] = "\nPROJECT \"", comment[] = "\n(*";
	struct about about = { NULL, NULL };
	const bool folder = g_file_test(path, G_FILE_TEST_IS_DIR);
	char *file = folder ? g_build_filename(path, FIRST_FILE, NULL) : g_strdup(path);
	gsize len;
	char *read = disk_read(file, LIMIT_TEXT, &len, NULL);
	char *text = read ? g_strconcat("\n", read, NULL) : NULL, *at;

	g_free(read);
	g_free(file);
	if (!text)
		return about;
	at = strstr(text, head);
	about.title = up_to(at ? at + strlen(head) : NULL, "\"");
	at = strstr(text, comment);
	about.line = up_to(at ? at + strlen(comment) : NULL, ".:*");
	g_free(text);
	return about;
}

static GtkWidget *label_new(const char *text, const char *class)
{
	GtkWidget *label = gtk_label_new(text);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_wrap(GTK_LABEL(label), TRUE);
	gtk_label_set_max_width_chars(GTK_LABEL(label), 1);
	gtk_label_set_lines(GTK_LABEL(label), 3);
	gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	gtk_widget_add_css_class(label, class);
	return label;
}

static GtkWidget *card_new(const char *path)
{
	GtkWidget *card = gtk_flow_box_child_new(), *sample = sample_new(path);
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
	char *name = g_path_get_basename(path);
	struct about about = about_of(path);
	char *spoken = g_strdup_printf("%s. %s", about.title ? about.title : name,
				       about.line ? about.line : "");

	spoken_name(sample, about.title ? about.title : name);
	gtk_widget_set_vexpand(sample, TRUE); /* cards are as high as the one with most text */
	gtk_box_append(GTK_BOX(box), sample);
	gtk_box_append(GTK_BOX(box), label_new(about.title ? about.title : name, "heading"));
	if (about.line)
		gtk_box_append(GTK_BOX(box), label_new(about.line, "caption"));
	gtk_box_append(GTK_BOX(box), label_new(name, "dim-label"));
	gtk_widget_add_css_class(card, "card");
	gtk_widget_add_css_class(card, "activatable");
	gtk_flow_box_child_set_child(GTK_FLOW_BOX_CHILD(card), box);
	g_object_set_data_full(G_OBJECT(card), "path", g_strdup(path), g_free);
	spoken_name(card, spoken);
	g_free(spoken);
	g_free(about.title);
	g_free(about.line);
	g_free(name);
	return card;
}

static void card_activated(GtkWidget *cards, GtkWidget *card)
{
	gtk_widget_activate_action(cards, "win.open-sample", "s",
				   g_object_get_data(G_OBJECT(card), "path"));
}

static GtkWidget *cards_new(void)
{
	GtkWidget *cards = gtk_flow_box_new();

	gtk_flow_box_set_selection_mode(GTK_FLOW_BOX(cards), GTK_SELECTION_NONE);
	gtk_flow_box_set_homogeneous(GTK_FLOW_BOX(cards), TRUE);
	gtk_flow_box_set_max_children_per_line(GTK_FLOW_BOX(cards), 4);
	gtk_flow_box_set_column_spacing(GTK_FLOW_BOX(cards), 12);
	gtk_flow_box_set_row_spacing(GTK_FLOW_BOX(cards), 12);
	gtk_widget_add_css_class(cards, "samples");
	spoken_name(cards, _("Samples, opened as copies"));
	g_signal_connect(cards, "child-activated", G_CALLBACK(card_activated), NULL);
	return cards;
}

static int depth(const char *path)
{
	int count = 0;

	for (; *path; path++)
		count += *path == G_DIR_SEPARATOR;
	return count;
}

/* Samples in folders of their own come last. */
static int by_name(gconstpointer a, gconstpointer b)
{
	const char *x = *(char *const *)a, *y = *(char *const *)b;

	return depth(x) != depth(y) ? depth(x) - depth(y) : strcmp(x, y);
}

/* The sample of an entry of the folder: a rung file, a folder of plain IEC text, or the rung file of a folder that has its
 * name. Plants are opened with their programs. NULL: none. Caller frees. */
static char *sample_of(const char *folder, const char *name)
{
	char *path = g_build_filename(folder, name, NULL), *first = g_build_filename(path, FIRST_FILE, NULL);
	char *file = g_strconcat(name, ".rung", NULL), *own = g_build_filename(path, file, NULL), *found = NULL;

	if (g_file_test(first, G_FILE_TEST_IS_REGULAR) ||
	    (g_str_has_suffix(path, ".rung") && !g_str_has_suffix(path, ".plant.rung")))
		found = g_strdup(path);
	else if (g_file_test(own, G_FILE_TEST_IS_REGULAR))
		found = g_strdup(own);
	g_free(own);
	g_free(file);
	g_free(first);
	g_free(path);
	return found;
}

static void add_samples(GtkWidget *groups)
{
	char *folder = samples_folder();
	GDir *dir = folder ? g_dir_open(folder, 0, NULL) : NULL;
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
	GtkWidget *cards = dir ? cards_new() : NULL;
	const char *name;

	while (dir && (name = g_dir_read_name(dir))) {
		char *path = sample_of(folder, name);

		if (path)
			g_ptr_array_add(names, path);
	}
	g_ptr_array_sort(names, by_name);
	for (guint i = 0; i < names->len; i++)
		gtk_flow_box_append(GTK_FLOW_BOX(cards), card_new(names->pdata[i]));
	if (cards)
		adw_preferences_group_add(ADW_PREFERENCES_GROUP(add_group(groups,
			_("Samples, opened as copies"), CARDS_WIDE)), cards);
	if (dir)
		g_dir_close(dir);
	g_ptr_array_unref(names);
	g_free(folder);
}

static GtkWidget *scrolled(GtkWidget *groups)
{
	GtkWidget *scroller = gtk_scrolled_window_new();

	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), groups);
	gtk_widget_set_vexpand(scroller, TRUE);
	return scroller;
}

GtkWidget *welcome_new(void)
{
	GtkWidget *page = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	GtkWidget *groups = gtk_box_new(GTK_ORIENTATION_VERTICAL, 14);
	GtkWidget *begin = add_group(groups, _("Begin"), ROWS_WIDE);

	add_row(begin, _("New project"), _("An empty sheet. Type a name to make a contact."),
		"win.begin", NULL);
	add_row(begin, _("New project with a chart"), _("A sequence of steps and transitions."),
		"win.begin-chart", NULL);
	add_row(begin, _("New project in Structured Text"), _("Statements and expressions as text."),
		"win.begin-statements", NULL);
	add_row(begin, _("New project with networks"), _("Boxes and wires: a Function Block Diagram."),
		"win.begin-networks", NULL);
	add_row(begin, _("Open a file…"), _("Rung files; IEC text: .st, .iec, .il, .EXP, .TcPOU"),
		"win.open", NULL);
	add_row(begin, _("Import…"), _("Projects of ClassicLadder, OpenPLC and LDmicro; PLCopen XML"),
		"win.import-project", NULL);
	add_row(begin, _("Compare files…"), _("What differs between two versions of a project."),
		"win.compare_files", NULL);
	add_row(begin, _("Tutorial"), _("Draw a first program, simulate it and run it on a board."),
		"win.tutorial", NULL);
	add_recent(groups);
	add_samples(groups);
	gtk_widget_add_css_class(groups, "welcome");
	gtk_box_append(GTK_BOX(page), scrolled(groups));
	return page;
}
