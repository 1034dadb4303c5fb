/* SPDX-License-Identifier: MIT
 *
 * board_finder - see board_finder.h. Avahi is asked over the system bus, so no library of it is
 * needed; ports and the socket of this machine are looked at again and again.
 */
#include "editor-gtk/online/board_finder.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/settings.h"

#include "online/stream.h"

#include <string.h>

#define LOOK_SECONDS 2     /* between two looks at the ports                  */
#define RECENT_MOST  8
#define AVAHI        "org.freedesktop.Avahi"
#define SERVICE_TYPE "_ladder._tcp"

struct _LadderBoardFinder {
	GObject parent;
	char *dev;
	GPtrArray *list;       /* of struct board_found                        */
	GPtrArray *network;    /* those of the network                         */
	char *why, *look;      /* `look`: what was seen last, as text          */
	GCancellable *cancel;
	GDBusConnection *bus;
	char *browser;         /* object path at Avahi; NULL: none             */
	guint heard[2], timer;
};

G_DEFINE_FINAL_TYPE(LadderBoardFinder, ladder_board_finder, G_TYPE_OBJECT)

static guint changed_signal;

static void found_free(gpointer data)
{
	struct board_found *found = data;

	g_free(found->where);
	g_free(found->title);
	g_free(found->about);
	g_free(found->key);
	g_free(found);
}

/* Takes over the texts. */
static struct board_found *found_new(enum found_kind kind, char *where, char *title, char *about)
{
	struct board_found *found = g_new0(struct board_found, 1);

	*found = (struct board_found){ .kind = kind, .where = where, .title = title,
				       .about = about };
	return found;
}

/* ---- boards that were connected ---- */

void board_recent_add(const char *where)
{
	GSettings *settings = settings_get();
	GPtrArray *boards;
	char **old;

	if (!settings)
		return;
	old = g_settings_get_strv(settings, "boards");
	boards = g_ptr_array_new();
	g_ptr_array_add(boards, (gpointer)where);
	for (int i = 0; old[i] && boards->len < RECENT_MOST; i++)
		if (strcmp(old[i], where) != 0)
			g_ptr_array_add(boards, old[i]);
	g_ptr_array_add(boards, NULL);
	g_settings_set_strv(settings, "boards", (const char *const *)boards->pdata);
	g_ptr_array_unref(boards);
	g_strfreev(old);
}

static void add_recent(GPtrArray *list)
{
	char **boards = settings_get() ? g_settings_get_strv(settings_get(), "boards") : NULL;

	for (int i = 0; boards && boards[i]; i++)
		if (strcmp(boards[i], "unix:") != 0)
			g_ptr_array_add(list, found_new(FOUND_RECENT, g_strdup(boards[i]),
				g_strdup(boards[i]), g_strdup(_("connected before"))));
	g_strfreev(boards);
}

/* ---- this machine ---- */

static void add_here(GPtrArray *list)
{
	const bool there = g_file_test(STREAM_SOCKET, G_FILE_TEST_EXISTS);

	g_ptr_array_add(list, found_new(FOUND_HERE, g_strdup("unix:"),
		g_strdup(_("This computer")), g_strdup(there ? _("ladderd listens") :
						       _("no ladderd listens"))));
}

/* A serial port, under the name that stays the same when other ports come and go. */
static void add_ports(GPtrArray *list, const char *dev)
{
	static const char *const kinds[] = { "ttyUSB", "ttyACM", "ttyAMA" };
	char *by_id = g_build_filename(dev, "serial", "by-id", NULL);
	GHashTable *named = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	GDir *dir = g_dir_open(by_id, 0, NULL);
	const char *name;

	while (dir && (name = g_dir_read_name(dir))) {
		char *path = g_build_filename(by_id, name, NULL);
		char *target = g_file_read_link(path, NULL);

		if (target)
			g_hash_table_add(named, g_path_get_basename(target));
		g_ptr_array_add(list, found_new(FOUND_SERIAL, g_strdup_printf("serial:%s", path),
			g_strdup(name), target ? g_path_get_basename(target) : g_strdup("")));
		g_free(target);
		g_free(path);
	}
	g_clear_pointer(&dir, g_dir_close);
	dir = g_dir_open(dev, 0, NULL);
	while (dir && (name = g_dir_read_name(dir)))
		for (gsize i = 0; i < G_N_ELEMENTS(kinds); i++)
			if (g_str_has_prefix(name, kinds[i]) && !g_hash_table_contains(named, name))
				g_ptr_array_add(list, found_new(FOUND_SERIAL,
					g_strdup_printf("serial:%s/%s", dev, name),
					g_strdup_printf("%s/%s", dev, name),
					g_strdup(_("serial port"))));
	g_clear_pointer(&dir, g_dir_close);
	g_hash_table_unref(named);
	g_free(by_id);
}

/* ---- the list ---- */

static gint by_kind(gconstpointer a, gconstpointer b)
{
	const struct board_found *one = *(struct board_found *const *)a;
	const struct board_found *other = *(struct board_found *const *)b;

	return one->kind != other->kind ? (int)one->kind - (int)other->kind :
	       one->kind == FOUND_RECENT ? 0 : strcmp(one->title, other->title);
}

static void look(LadderBoardFinder *finder)
{
	GPtrArray *list = g_ptr_array_new_with_free_func(found_free);
	GString *seen = g_string_new(finder->why);

	add_here(list);
	add_recent(list);
	for (guint i = 0; i < finder->network->len; i++) {
		const struct board_found *found = finder->network->pdata[i];

		g_ptr_array_add(list, found_new(FOUND_NETWORK, g_strdup(found->where),
			g_strdup(found->title), g_strdup(found->about)));
	}
	add_ports(list, finder->dev);
	g_ptr_array_sort(list, by_kind);
	for (guint i = 0; i < list->len; i++) {
		const struct board_found *found = list->pdata[i];

		g_string_append_printf(seen, "\n%s\t%s\t%s", found->where, found->title,
				       found->about);
	}
	g_clear_pointer(&finder->list, g_ptr_array_unref);
	finder->list = list;
	if (g_strcmp0(finder->look, seen->str) != 0) {
		g_free(finder->look);
		finder->look = g_strdup(seen->str);
		g_signal_emit(finder, changed_signal, 0);
	}
	g_string_free(seen, TRUE);
}

static gboolean look_again(gpointer finder)
{
	look(finder);
	return G_SOURCE_CONTINUE;
}

/* ---- Avahi ---- */

/* A service is known by its interface, its protocol and its name. */
static char *key_of(gint32 interface, gint32 protocol, const char *name)
{
	return g_strdup_printf("%d %d %s", interface, protocol, name);
}

static void forget_service(LadderBoardFinder *finder, const char *key)
{
	for (guint i = 0; i < finder->network->len; i++) {
		const struct board_found *found = finder->network->pdata[i];

		if (strcmp(found->key, key) == 0) {
			g_ptr_array_remove_index(finder->network, i);
			return;
		}
	}
}

/* "user=pi" of the texts of a service. NULL: none. Caller frees. */
static char *text_of(GVariant *texts, const char *word)
{
	const gsize len = strlen(word);
	char *found = NULL;

	for (gsize i = 0; i < g_variant_n_children(texts) && !found; i++) {
		GVariant *child = g_variant_get_child_value(texts, i);
		gsize size;
		const char *bytes = g_variant_get_fixed_array(child, &size, 1);

		if (size > len && strncmp(bytes, word, len) == 0)
			found = g_strndup(bytes + len, size - len);
		g_variant_unref(child);
	}
	return found;
}

/* Only a host that ssh may be given is listed. */
static void add_service(LadderBoardFinder *finder, GVariant *answer)
{
	gint32 interface, protocol, aprotocol;
	const char *name, *type, *domain, *host, *address;
	guint16 port;
	guint32 flags;
	GVariant *texts;
	char *user, *where;

	g_variant_get(answer, "(ii&s&s&s&si&sq@aayu)", &interface, &protocol, &name, &type,
		      &domain, &host, &aprotocol, &address, &port, &texts, &flags);
	user = text_of(texts, "user=");
	where = user ? g_strdup_printf("%s@%s", user, host) : g_strdup(host);
	if (stream_is_host(where) && g_utf8_validate(name, -1, NULL)) {
		struct board_found *found = found_new(FOUND_NETWORK, g_strdup(where),
			g_strdup(name), g_strdup_printf(_("found in the network · %s"), host));

		found->key = key_of(interface, protocol, name);
		forget_service(finder, found->key);
		/* The same board by IPv4 and IPv6 is one. */
		for (guint i = 0; i < finder->network->len; i++) {
			const struct board_found *other = finder->network->pdata[i];

			if (found && strcmp(other->where, where) == 0 &&
			    strcmp(other->title, name) == 0)
				g_clear_pointer(&found, found_free);
		}
		if (found)
			g_ptr_array_add(finder->network, found);
	}
	g_variant_unref(texts);
	g_free(where);
	g_free(user);
	look(finder);
}

static void resolved(GObject *bus, GAsyncResult *result, gpointer data)
{
	GError *error = NULL;
	GVariant *answer = g_dbus_connection_call_finish(G_DBUS_CONNECTION(bus), result, &error);

	if (answer)
		add_service(data, answer);
	g_clear_pointer(&answer, g_variant_unref);
	g_clear_error(&error); /* cancelled, or it has gone again */
	g_object_unref(data);
}

static void item(GDBusConnection *bus, const char *sender, const char *path, const char *interface,
		 const char *signal, GVariant *fields, gpointer data)
{
	LadderBoardFinder *finder = data;
	gint32 network, protocol;
	const char *name, *type, *domain;
	guint32 flags;
	char *key;

	(void)sender;
	(void)path;
	(void)interface;
	if (!g_variant_is_of_type(fields, G_VARIANT_TYPE("(iisssu)")))
		return;
	g_variant_get(fields, "(ii&s&s&su)", &network, &protocol, &name, &type, &domain, &flags);
	if (strcmp(type, SERVICE_TYPE) != 0)
		return;
	if (strcmp(signal, "ItemNew") == 0) {
		g_dbus_connection_call(bus, AVAHI, "/", AVAHI ".Server", "ResolveService",
			g_variant_new("(iisssiu)", network, protocol, name, type, domain, -1, 0u),
			G_VARIANT_TYPE("(iissssisqaayu)"), 0, -1, finder->cancel, resolved,
			g_object_ref(finder));
		return;
	}
	key = key_of(network, protocol, name);
	forget_service(finder, key);
	g_free(key);
	look(finder);
}

static void no_network(LadderBoardFinder *finder)
{
	g_free(finder->why);
	finder->why = g_strdup(_("Boards in the network cannot be found: Avahi does not run here."));
	look(finder);
}

static void browsed(GObject *bus, GAsyncResult *result, gpointer data)
{
	GError *error = NULL;
	GVariant *answer = g_dbus_connection_call_finish(G_DBUS_CONNECTION(bus), result, &error);
	LadderBoardFinder *finder = data;

	if (answer)
		g_variant_get(answer, "(o)", &finder->browser);
	else if (!g_error_matches(error, G_IO_ERROR, G_IO_ERROR_CANCELLED))
		no_network(finder);
	g_clear_pointer(&answer, g_variant_unref);
	g_clear_error(&error);
	g_object_unref(data);
}

/* The signals of the browser may come before the answer that names it. */
static void got_bus(GObject *source, GAsyncResult *result, gpointer data)
{
	static const char *const signals[] = { "ItemNew", "ItemRemove" };
	LadderBoardFinder *finder = data;
	GError *error = NULL;
	GDBusConnection *bus = g_bus_get_finish(result, &error);

	(void)source;
	if (bus && !g_cancellable_is_cancelled(finder->cancel)) {
		finder->bus = bus;
		for (gsize i = 0; i < G_N_ELEMENTS(signals); i++)
			finder->heard[i] = g_dbus_connection_signal_subscribe(bus, AVAHI,
				AVAHI ".ServiceBrowser", signals[i], NULL, NULL, 0, item, finder,
				NULL);
		g_dbus_connection_call(bus, AVAHI, "/", AVAHI ".Server", "ServiceBrowserNew",
			g_variant_new("(iissu)", -1, -1, SERVICE_TYPE, "", 0u),
			G_VARIANT_TYPE("(o)"), 0, -1, finder->cancel, browsed,
			g_object_ref(finder));
	} else if (!g_cancellable_is_cancelled(finder->cancel)) {
		no_network(finder);
	} else {
		g_clear_object(&bus);
	}
	g_clear_error(&error);
	g_object_unref(finder);
}

/* ---- life ---- */

GPtrArray *ladder_board_finder_list(LadderBoardFinder *finder)
{
	return finder->list;
}

const char *ladder_board_finder_why(LadderBoardFinder *finder)
{
	return finder->why;
}

static void ladder_board_finder_dispose(GObject *object)
{
	LadderBoardFinder *finder = LADDER_BOARD_FINDER(object);

	g_cancellable_cancel(finder->cancel);
	g_clear_handle_id(&finder->timer, g_source_remove);
	for (gsize i = 0; i < G_N_ELEMENTS(finder->heard) && finder->bus; i++)
		g_dbus_connection_signal_unsubscribe(finder->bus, finder->heard[i]);
	if (finder->browser) /* else Avahi stores it until the editor ends */
		g_dbus_connection_call(finder->bus, AVAHI, finder->browser,
			AVAHI ".ServiceBrowser", "Free", NULL, NULL, 0, -1, NULL, NULL, NULL);
	g_clear_pointer(&finder->browser, g_free);
	g_clear_object(&finder->bus);
	G_OBJECT_CLASS(ladder_board_finder_parent_class)->dispose(object);
}

static void ladder_board_finder_finalize(GObject *object)
{
	LadderBoardFinder *finder = LADDER_BOARD_FINDER(object);

	g_clear_pointer(&finder->list, g_ptr_array_unref);
	g_ptr_array_unref(finder->network);
	g_object_unref(finder->cancel);
	g_free(finder->dev);
	g_free(finder->why);
	g_free(finder->look);
	G_OBJECT_CLASS(ladder_board_finder_parent_class)->finalize(object);
}

static void ladder_board_finder_class_init(LadderBoardFinderClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_board_finder_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_board_finder_finalize;
	changed_signal = g_signal_new("changed", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0,
				      NULL, NULL, NULL, G_TYPE_NONE, 0);
}

static void ladder_board_finder_init(LadderBoardFinder *finder)
{
	finder->cancel = g_cancellable_new();
	finder->network = g_ptr_array_new_with_free_func(found_free);
}

LadderBoardFinder *ladder_board_finder_new(const char *dev)
{
	LadderBoardFinder *finder = g_object_new(LADDER_TYPE_BOARD_FINDER, NULL);

	finder->dev = g_strdup(dev ? dev : "/dev");
	look(finder);
	finder->timer = g_timeout_add_seconds(LOOK_SECONDS, look_again, finder);
	g_bus_get(G_BUS_TYPE_SYSTEM, NULL, got_bus, g_object_ref(finder));
	return finder;
}
