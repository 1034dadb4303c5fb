/* SPDX-License-Identifier: MIT
 *
 * app - the command line of the editor, its windows, and its end.
 *
 * --render is handled before a display is opened.
 */
#include "editor-gtk/window/app.h"

#include "editor-gtk/document/classic.h"
#include "editor-gtk/document/plain_file.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/draft.h"
#include "editor-gtk/document/side_file.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/installed.h"
#include "editor-gtk/kit/memory.h"
#include "editor-gtk/kit/theme.h"
#include "editor-gtk/kit/gtk48/blink.h"
#include "editor-gtk/kit/gtk48/gl.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/press.h"
#include "editor-gtk/kit/gtk48/slow_bar.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/window/preferences.h"
#include "editor-gtk/window/recent.h"
#include "editor-gtk/render/render.h"
#include "editor-gtk/window/usage.h"
#include "editor-gtk/window/window.h"

#include <glib-unix.h>
#include <gtksourceview/gtksource.h>
#include <locale.h>
#include <signal.h>
#include <string.h>

/* ---- windows ---- */

static void open_wanted(LadderWindow *window, const char *path, gboolean as_copy,
			AdwApplication *application);
static void open_on_board_wanted(LadderWindow *window, const char *path,
				 AdwApplication *application);
static void new_wanted(LadderWindow *window, AdwApplication *application);

static LadderWindow *show_document(AdwApplication *application, LadderDocument *document)
{
	LadderWindow *window = ladder_window_new(application, document);

	g_signal_connect(window, "open-wanted", G_CALLBACK(open_wanted), application);
	g_signal_connect(window, "open-on-board-wanted", G_CALLBACK(open_on_board_wanted),
			 application);
	g_signal_connect(window, "new-wanted", G_CALLBACK(new_wanted), application);
	draft_keep(document);
	gtk_window_present(GTK_WINDOW(window));
	return window;
}

static LadderWindow *new_window(AdwApplication *application)
{
	LadderDocument *document = ladder_document_new();
	LadderWindow *window = show_document(application, document);

	g_object_unref(document);
	return window;
}

/* The document of an untouched window, else a new one. Caller: g_object_unref(). */
static LadderDocument *document_for(LadderWindow *window)
{
	return window && ladder_window_is_untouched(window) ?
	       g_object_ref(ladder_window_document(window)) : ladder_document_new();
}

/* Shows @document, which was just opened, in @window if that is its window, else in a new
 * one. */
static LadderWindow *show_opened(AdwApplication *application, LadderWindow *window,
				 LadderDocument *document)
{
	if (!window || ladder_window_document(window) != document)
		return show_document(application, document);
	ladder_window_opened(window);
	return window;
}

static LadderWindow *open_in(AdwApplication *application, LadderWindow *window,
			     const char *path, GError **error)
{
	LadderDocument *document = document_for(window);

	window = ladder_document_open(document, path, error) ?
		show_opened(application, window, document) : NULL;
	if (window) {
		recent_add(path);
		ladder_window_tell_file(window);
	}
	g_object_unref(document);
	return window;
}

static bool has_open(LadderWindow *window, const char *path)
{
	const char *open = ladder_document_path(ladder_window_document(window));

	return (open && disk_same(path, open)) || ladder_window_has_file(window, path);
}

/* The window in which this project, or this file beside a project, is open; NULL: none. */
static LadderWindow *window_of(AdwApplication *application, const char *path)
{
	GList *at = gtk_application_get_windows(GTK_APPLICATION(application));
	char *whole = g_canonicalize_filename(path, NULL);
	LadderWindow *found = NULL;

	for (; at && !found; at = at->next)
		if (LADDER_IS_WINDOW(at->data) && has_open(at->data, whole))
			found = at->data;
	g_free(whole);
	return found;
}

/* The project has no path until a person saves it as a rung file. */
static LadderWindow *open_classic(AdwApplication *application, LadderWindow *window,
				  const char *path, GError **error)
{
	char *place = g_strdup(path), *text;
	LadderDocument *document;
	struct ladder *ladder;
	LadderOrigin *origin;
	gsize len = 0;

	text = classic_import(place, &len, &ladder, error);
	if (!text) {
		g_free(place);
		return NULL;
	}
	document = document_for(window);
	ladder_document_open_text(document, NULL, text, len, false);
	window = show_opened(application, window, document);
	ladder_window_set_origin(window, path);
	recent_add(path);
	origin = ladder_origin_new(document, place, ladder);
	ladder_window_set_classic(window, origin);
	g_object_unref(origin);
	g_object_unref(document);
	g_free(text);
	return window;
}

/* A folder of IEC text, or a file of another tool, has no path until a person saves it. */
static LadderWindow *open_plain(AdwApplication *application, LadderWindow *window,
				const char *path, GError **error)
{
	const bool may = plain_file_is(path) || g_file_test(path, G_FILE_TEST_IS_DIR);
	LadderDocument *document;
	gsize len = 0;
	char *text = may ? plain_file_import(path, &len) : NULL;

	if (!text)
		return open_in(application, window, path, error);
	document = document_for(window);
	ladder_document_open_text(document, NULL, text, len, false);
	window = show_opened(application, window, document);
	ladder_window_set_origin(window, path);
	recent_add(path);
	g_object_unref(document);
	g_free(text);
	return window;
}

/* An I/O map that belongs to no project and that the tree of this window lists. */
static bool is_listed(LadderWindow *window, const char *path)
{
	GPtrArray *maps = side_file_list(ladder_document_path(ladder_window_document(window)),
				       ".io", false);
	const bool found = g_ptr_array_find_with_equal_func(maps, path, g_str_equal, NULL);

	g_ptr_array_unref(maps);
	return found;
}

/* Opens a scenario or an I/O map together with its project, if there is one. */
static LadderWindow *open_beside(AdwApplication *application, LadderWindow *window,
				 const char *path, GError **error)
{
	char *project = side_file_project(path);
	LadderWindow *shown = project ? window_of(application, project) : NULL;

	if (project && !shown)
		shown = open_plain(application, window, project, error);
	else if (!project)
		shown = window && (ladder_window_is_untouched(window) ||
				   is_listed(window, path)) ? window :
			new_window(application);
	if (shown) {
		ladder_window_show_file(shown, path);
		gtk_window_present(GTK_WINDOW(shown));
	}
	g_free(project);
	return shown;
}

static LadderWindow *open_any(AdwApplication *application, LadderWindow *window,
			      const char *path, GError **error)
{
	LadderWindow *there = window_of(application, path);

	if (there) { /* two windows would overwrite each other's file */
		if (side_file_is(path))
			ladder_window_show_file(there, path);
		else
			recent_add(path);
		gtk_window_present(GTK_WINDOW(there));
		return there;
	}
	if (side_file_is(path))
		return open_beside(application, window, path, error);
	if (classic_is_project(path))
		return open_classic(application, window, path, error);
	return open_plain(application, window, path, error);
}

static void open_sample(AdwApplication *application, LadderWindow *window, const char *path,
			GError **error)
{
	LadderDocument *document;
	const bool folder = g_file_test(path, G_FILE_TEST_IS_DIR);
	gsize len;
	char *text = folder ? plain_file_import(path, &len) : disk_read(path, LIMIT_TEXT, &len, error);

	if (!text)
		return;
	document = document_for(window);
	ladder_document_open_copy(document, folder ? NULL : path, text, len, true);
	window = show_opened(application, window, document);
	ladder_window_set_origin(window, path);
	draft_of_sample(document, path);
	g_object_unref(document);
	g_free(text);
}

static void open_wanted(LadderWindow *window, const char *path, gboolean as_copy,
			AdwApplication *application)
{
	GError *error = NULL;

	if (as_copy)
		open_sample(application, window, path, &error);
	else
		open_any(application, window, path, &error);
	if (error)
		ladder_window_warn(window, error->message);
	g_clear_error(&error);
}

static void open_on_board_wanted(LadderWindow *window, const char *path,
				 AdwApplication *application)
{
	GError *error = NULL;
	LadderWindow *opened = open_any(application, window, path, &error);

	if (opened && opened != window)
		ladder_window_share_board(opened, window);
	if (error)
		ladder_window_warn(window, error->message);
	g_clear_error(&error);
}

static void new_wanted(LadderWindow *window, AdwApplication *application)
{
	(void)window;
	new_window(application);
}

/* ---- after a crash ---- */

/* If the file is open already, the draft is restored as a program without a file. */
static bool restore_document(AdwApplication *application, const struct draft *draft)
{
	const bool twice = draft->path && window_of(application, draft->path);
	LadderDocument *document = ladder_document_new();
	LadderWindow *window;
	bool kept;

	if (draft->sample && !draft->path && g_file_test(draft->sample, G_FILE_TEST_IS_REGULAR))
		ladder_document_open_copy(document, draft->sample, draft->text, draft->len, false);
	else
		ladder_document_restore(document, twice ? NULL : draft->path,
					twice ? NULL : draft->sum, draft->text, draft->len);
	window = show_document(application, document);
	if (draft->sample && !draft->path) {
		ladder_window_set_origin(window, draft->sample);
		draft_of_sample(document, draft->sample);
	}
	kept = draft_is_kept(document);
	if (kept)
		ladder_window_offer_restored(window);
	g_object_unref(document);
	return kept;
}

/* Opens the project of the file too, if it still exists. */
static bool restore_file(AdwApplication *application, const struct draft *draft)
{
	LadderWindow *window = draft->beside ?
		open_any(application, NULL, draft->beside, NULL) : NULL;
	bool kept;

	if (!window)
		window = new_window(application);
	kept = ladder_window_restore_file(window, draft);
	if (kept)
		ladder_window_offer_restored(window);
	return kept;
}

/* A draft is deleted only when its contents are kept as a draft of this editor. */
static int restore_drafts(AdwApplication *application)
{
	GPtrArray *drafts = draft_find();
	const int count = (int)drafts->len;

	for (int i = 0; i < count; i++) {
		const struct draft *draft = drafts->pdata[i];

		if (draft->is_file ? restore_file(application, draft) :
				     restore_document(application, draft))
			draft_forget(draft);
	}
	g_ptr_array_unref(drafts);
	return count;
}

static LadderWindow *window_with(LadderDocument *document)
{
	GList *at = gtk_application_get_windows(GTK_APPLICATION(g_application_get_default()));

	for (; at; at = at->next)
		if (LADDER_IS_WINDOW(at->data) &&
		    ladder_window_document(LADDER_WINDOW(at->data)) == document)
			return LADDER_WINDOW(at->data);
	return NULL;
}

static void tell_draft_failed(gpointer object, const char *why)
{
	LadderWindow *window = window_with(LADDER_IS_DOCUMENT(object) ? object :
					   ladder_side_file_document(object));
	char *text = g_strdup_printf(_("Cannot keep a draft, so a crash would lose your "
				       "unsaved changes: %s"), why);

	if (window)
		ladder_window_warn(window, text);
	g_free(text);
}

/* ---- signals that end the program ---- */

/* Ends the editor without questions; unsaved changes are restored at the next start. */
static gboolean end_now(gpointer application)
{
	GList *windows = g_list_copy(gtk_application_get_windows(application));

	for (GList *at = windows; at; at = at->next)
		if (LADDER_IS_WINDOW(at->data))
			ladder_window_keep_drafts(LADDER_WINDOW(at->data));
	g_list_free(windows);
	while ((windows = gtk_application_get_windows(application)))
		gtk_window_destroy(GTK_WINDOW(windows->data));
	g_application_quit(G_APPLICATION(application));
	return G_SOURCE_CONTINUE;
}

static void follow_signals(gpointer application)
{
	static const int numbers[] = { SIGTERM, SIGINT, SIGHUP };

	for (gsize i = 0; i < G_N_ELEMENTS(numbers); i++)
		g_unix_signal_add(numbers[i], end_now, application);
}

/* ---- the application ---- */

static void activate(AdwApplication *application)
{
	if (restore_drafts(application) == 0)
		ladder_window_welcome(new_window(application));
}

static void open_files(AdwApplication *application, GFile **files, int count,
		       const char *hint)
{
	(void)hint;
	restore_drafts(application);
	for (int i = 0; i < count; i++) {
		char *path = g_file_get_path(files[i]);
		GError *error = NULL;
		LadderWindow *window = path ? open_any(application, NULL, path, &error) :
			NULL;

		if (!window) {
			window = new_window(application);
			ladder_window_warn(window, error ? error->message :
					   _("Only files on this machine can be opened."));
		}
		g_clear_error(&error);
		g_free(path);
	}
}

/* `--compare OLD NEW` */
static void compare_opened(AdwApplication *application, GFile **files, int count,
			   const char *hint)
{
	char *older = g_file_get_path(files[0]), *newer = count > 1 ? g_file_get_path(files[1]) :
		      NULL;
	LadderWindow *window;

	(void)hint;
	restore_drafts(application);
	window = new_window(application);
	if (older && newer)
		ladder_window_compare(window, older, newer);
	else
		ladder_window_warn(window, _("Only files on this machine can be opened."));
	g_free(newer);
	g_free(older);
}

static void add_css(GtkCssProvider *css)
{
	gtk_style_context_add_provider_for_display(gdk_display_get_default(),
		GTK_STYLE_PROVIDER(css), GTK_STYLE_PROVIDER_PRIORITY_APPLICATION);
}

/* Widgets have the colours of the sheets for a force and for what was added. */
static void define_colors(GtkCssProvider *css)
{
	const struct theme *theme = theme_screen();
	char *force = gdk_rgba_to_string(&theme->color[TOKEN_FORCE]);
	char *text = gdk_rgba_to_string(&theme->color[TOKEN_BADGE]);
	char *power = gdk_rgba_to_string(&theme->color[TOKEN_POWER]);
	char *found = gdk_rgba_to_string(&theme->color[TOKEN_FOUND]);
	char *found_now = gdk_rgba_to_string(&theme->color[TOKEN_FOUND_NOW]);
	char *ink = gdk_rgba_to_string(&theme->color[TOKEN_INK]);
	char *rules = g_strdup_printf("@define-color force_color %s;\n"
				      "@define-color force_text_color %s;\n"
				      "@define-color power_color %s;\n"
				      "@define-color found_color %s;\n"
				      "@define-color found_now_color %s;\n"
				      "@define-color found_text_color %s;\n",
				      force, text, power, found, found_now, ink);

	gtk_css_provider_load_from_data(css, rules, -1);
	g_free(rules);
	g_free(ink);
	g_free(found_now);
	g_free(found);
	g_free(power);
	g_free(text);
	g_free(force);
}

/* A sheet that applies with high contrast only; its path is the data of the provider. */
static void use_contrast(GtkCssProvider *css)
{
	const char *path = theme_is_high() ? g_object_get_data(G_OBJECT(css), "path") : NULL;

	if (path)
		gtk_css_provider_load_from_resource(css, path);
	else
		gtk_css_provider_load_from_data(css, "", 0);
}

/* The sheet of libadwaita is where libadwaita 1.2 to 1.7 have it: they offer no function for the choice. */
static void follow_contrast(guint priority, const char *path)
{
	GtkCssProvider *css;

	if (!g_resources_get_info(path, G_RESOURCE_LOOKUP_FLAGS_NONE, NULL, NULL, NULL))
		return;
	css = gtk_css_provider_new();
	g_object_set_data(G_OBJECT(css), "path", (gpointer)path);
	gtk_style_context_add_provider_for_display(gdk_display_get_default(),
						   GTK_STYLE_PROVIDER(css), priority);
	use_contrast(css);
	theme_follow(css, G_CALLBACK(use_contrast));
	g_object_unref(css);
}

void app_style(void)
{
	GtkCssProvider *css = gtk_css_provider_new(), *colors = gtk_css_provider_new();

	define_colors(colors);
	add_css(colors);
	theme_follow(colors, G_CALLBACK(define_colors));
	gtk_css_provider_load_from_resource(css, "/org/rungboard/Editor/ui/style.css");
	add_css(css);
	follow_contrast(GTK_STYLE_PROVIDER_PRIORITY_THEME + 1,
			"/org/gnome/Adwaita/styles/base-hc.css");
	follow_contrast(GTK_STYLE_PROVIDER_PRIORITY_APPLICATION + 1,
			"/org/rungboard/Editor/ui/contrast.css");
	g_object_unref(colors);
	g_object_unref(css);
}

/* A dialog is named when all its buttons are there. */
static void windows_changed(GListModel *windows, guint at, guint removed, guint added)
{
	(void)removed;
	for (guint i = at; i < at + added; i++) {
		GtkWidget *window = g_list_model_get_item(windows, i);

		if (ADW_IS_MESSAGE_DIALOG(window))
			g_signal_connect(window, "map", G_CALLBACK(spoken_parts), NULL);
		blink_follow(GTK_WINDOW(window));
		g_object_unref(window);
	}
}

static void startup(GtkApplication *application)
{
	gl_forget();
	gtk_source_init();
	app_style();
	popover_init();
	press_init();
	slow_bar_choose_all();
	preferences_follow(ADW_APPLICATION(application));
	gtk_window_set_default_icon_name(APP_ID);
	/* A text that the keys reach is not marked as a whole; Ctrl+A does that. */
	g_object_set(gtk_settings_get_default(), "gtk-label-select-on-focus", FALSE, NULL);
	draft_on_failure(tell_draft_failed);
	g_signal_connect(gtk_window_get_toplevels(), "items-changed", G_CALLBACK(windows_changed),
			 NULL);
}

/* The folder of translations; NULL: none. */
static char *languages_folder(void)
{
	const char *told = g_getenv("RUNGBOARD_LOCALE");

	return told ? g_strdup(told) : installed_folder("locale", "locale");
}

/* Numbers keep a decimal point, because they are written to files. */
static void set_language(void)
{
	char *folder = languages_folder();

	setlocale(LC_ALL, "");
	setlocale(LC_NUMERIC, "C");
	gtk_disable_setlocale();
	if (folder)
		bindtextdomain(GETTEXT_PACKAGE, folder);
	g_free(folder);
	bind_textdomain_codeset(GETTEXT_PACKAGE, "UTF-8");
	textdomain(GETTEXT_PACKAGE);
}

static bool is_render(int argc, char **argv)
{
	for (int i = 1; i < argc; i++)
		if (strcmp(argv[i], "--render") == 0)
			return true;
	return false;
}

int app_run(int argc, char **argv)
{
	const bool compares = usage_compares(argc, argv);
	AdwApplication *application;
	int status;

	set_language();
	memory_keep_frames();
	/* Writing beyond the limit on file size then fails with EFBIG, which is reported. */
	signal(SIGXFSZ, SIG_IGN);
	if (is_render(argc, argv))
		return render_main(argc, argv);
	if (usage_main(argc, argv, &status))
		return status;
	gl_spare();
	application = adw_application_new(APP_ID,
		G_APPLICATION_HANDLES_OPEN | G_APPLICATION_NON_UNIQUE);
	g_application_set_option_context_parameter_string(G_APPLICATION(application),
							  _("[FILE…]"));
	g_signal_connect_after(application, "startup", G_CALLBACK(startup), NULL);
	g_signal_connect(application, "activate", G_CALLBACK(activate), NULL);
	g_signal_connect(application, "open", compares ? G_CALLBACK(compare_opened) :
			 G_CALLBACK(open_files), NULL);
	follow_signals(application);
	if (compares) { /* GApplication gets the files alone */
		argv[1] = argv[0];
		argc--;
		argv++;
	}
	status = g_application_run(G_APPLICATION(application), argc, argv);
	g_object_unref(application);
	return status;
}
