/* SPDX-License-Identifier: MIT
 *
 * walk - loaded into the editor before its libraries (LD_PRELOAD): answers one question on the accessibility
 * bus with all visible widgets, which otherwise takes a question for each.
 *
 * It asks the toolkit's own handlers of these questions, so names, roles, states and children are what a
 * screen reader gets. finder.py uses it, and asks on the bus itself if it is not there.
 */
#include <gio/gio.h>

#include <dlfcn.h>
#include <stdbool.h>
#include <string.h>

#define ACCESSIBLE "org.a11y.atspi.Accessible"
#define COMPONENT "org.a11y.atspi.Component"

/* An object on the bus. */
struct object {
	const GDBusInterfaceVTable *handler; /* of ACCESSIBLE */
	gpointer data;
	guint32 role;                        /* 0: not asked for yet; it never changes */
	bool widget;                         /* it has a COMPONENT */
};

static GHashTable *objects;       /* path -> struct object */
static GHashTable *paths;         /* id of a registration -> path */
static GDBusConnection *bus;
static int stand_in;              /* its address is the invocation of a question of our own */
static GVariant *answer;          /* to it */

static const char about[] =
	"<node><interface name='rungboard.Walk'><method name='Walk'>"
	"<arg type='o' direction='in'/><arg type='s' direction='in'/><arg type='u' direction='in'/>"
	"<arg type='a(ooiisuub)' direction='out'/></method></interface></node>";

/* The function of the library that one here stands before. */
static void *original(const char *name)
{
	static void *library;

	if (!library)
		library = dlopen("libgio-2.0.so.0", RTLD_LAZY);
	return dlsym(library, name);
}

static bool is_ours(GDBusMethodInvocation *invocation)
{
	return (void *)invocation == (void *)&stand_in;
}

void g_dbus_method_invocation_return_value(GDBusMethodInvocation *invocation, GVariant *value)
{
	static void (*next)(GDBusMethodInvocation *, GVariant *);

	if (is_ours(invocation)) {
		answer = value ? g_variant_ref_sink(value) : NULL;
		return;
	}
	if (!next)
		*(void **)&next = original("g_dbus_method_invocation_return_value");
	next(invocation, value);
}

void g_dbus_method_invocation_return_error_literal(GDBusMethodInvocation *invocation, GQuark domain, gint code,
						   const gchar *message)
{
	static void (*next)(GDBusMethodInvocation *, GQuark, gint, const gchar *);

	if (is_ours(invocation))
		return;
	if (!next)
		*(void **)&next = original("g_dbus_method_invocation_return_error_literal");
	next(invocation, domain, code, message);
}

void g_dbus_method_invocation_return_error(GDBusMethodInvocation *invocation, GQuark domain, gint code,
					   const gchar *format, ...)
{
	va_list args;
	char *message;

	va_start(args, format);
	message = g_strdup_vprintf(format, args);
	va_end(args);
	g_dbus_method_invocation_return_error_literal(invocation, domain, code, message);
	g_free(message);
}

/* The answer to a question without arguments; NULL: none. Owns: the caller. */
static GVariant *ask(const char *path, const struct object *object, const char *method)
{
	answer = NULL;
	object->handler->method_call(bus, "", path, ACCESSIBLE, method, g_variant_new("()"),
				     (GDBusMethodInvocation *)(void *)&stand_in, object->data);
	return answer;
}

/* The first number of an answer of the type (u) or (au). */
static guint32 number(const char *path, const struct object *object, const char *method)
{
	GVariant *got = ask(path, object, method);
	guint32 value = 0;

	if (!got)
		return 0;
	if (g_variant_is_of_type(got, G_VARIANT_TYPE("(au)"))) {
		GVariant *list = g_variant_get_child_value(got, 0);

		if (g_variant_n_children(list))
			g_variant_get_child(list, 0, "u", &value);
		g_variant_unref(list);
	} else {
		g_variant_get_child(got, 0, "u", &value);
	}
	g_variant_unref(got);
	return value;
}

static char *name_of(const char *path, const struct object *object)
{
	GError *error = NULL;
	GVariant *got = object->handler->get_property(bus, "", path, ACCESSIBLE, "Name", &error, object->data);
	char *name = got ? g_variant_dup_string(got, NULL) : g_strdup("");

	g_clear_error(&error);
	if (got)
		g_variant_unref(g_variant_ref_sink(got));
	return name;
}

struct step {
	char *path, *parent;
	int place;
};

static void step_free(gpointer step)
{
	g_free(((struct step *)step)->path);
	g_free(((struct step *)step)->parent);
	g_free(step);
}

/* Adds the row of a widget to @rows and its parts to @steps; without parts if its name and role say so. */
static void add(GVariantBuilder *rows, GPtrArray *steps, const struct step *step, const char *closed,
		guint32 role_closed)
{
	struct object *object = g_hash_table_lookup(objects, step->path);
	GVariant *children = NULL, *list;
	char *name = name_of(step->path, object);
	gsize count = 0;

	if (!object->role)
		object->role = number(step->path, object, "GetRole");
	if (steps->len == 1 || object->role != role_closed || strcmp(name, closed) != 0)
		children = ask(step->path, object, "GetChildren");
	if (children) {
		list = g_variant_get_child_value(children, 0);
		count = g_variant_n_children(list);
		for (gsize i = 0; i < count; i++) {
			struct step *next = g_new(struct step, 1);

			g_variant_get_child(list, i, "(&so)", NULL, &next->path);
			next->parent = g_strdup(step->path);
			next->place = (int)i;
			g_ptr_array_add(steps, next);
		}
		g_variant_unref(list);
		g_variant_unref(children);
	}
	g_variant_builder_add(rows, "(ooiisuub)", step->path, step->parent, step->place, (int)count, name,
			      object->role, number(step->path, object, "GetState"), (gboolean)object->widget);
	g_free(name);
}

/* Walk(top, name, role): rows of @top and all visible widgets in it, each level after the one above. */
static void walk(GDBusConnection *connection, const char *sender, const char *path, const char *interface,
		 const char *method, GVariant *args, GDBusMethodInvocation *invocation, gpointer data)
{
	GPtrArray *steps = g_ptr_array_new_with_free_func(step_free);
	struct step *top = g_new0(struct step, 1);
	const char *closed;
	GVariantBuilder rows;
	guint32 role;

	(void)connection, (void)sender, (void)path, (void)interface, (void)method, (void)data;
	g_variant_get(args, "(o&su)", &top->path, &closed, &role);
	top->parent = g_strdup("/");
	g_ptr_array_add(steps, top);
	g_variant_builder_init(&rows, G_VARIANT_TYPE("a(ooiisuub)"));
	for (guint i = 0; i < steps->len; i++) {
		const struct step *step = steps->pdata[i];

		if (g_hash_table_contains(objects, step->path))
			add(&rows, steps, step, closed, role);
	}
	g_ptr_array_unref(steps);
	g_dbus_method_invocation_return_value(invocation, g_variant_new("(a(ooiisuub))", &rows));
}

static guint really_register(GDBusConnection *connection, const gchar *path, GDBusInterfaceInfo *info,
			     const GDBusInterfaceVTable *handler, gpointer data, GDestroyNotify free_data, GError **error)
{
	static guint (*next)(GDBusConnection *, const gchar *, GDBusInterfaceInfo *, const GDBusInterfaceVTable *,
			     gpointer, GDestroyNotify, GError **);

	if (!next)
		*(void **)&next = original("g_dbus_connection_register_object");
	return next(connection, path, info, handler, data, free_data, error);
}

/* The first object of the accessibility bus: answers on it from now on. */
static void begin(GDBusConnection *connection)
{
	static const GDBusInterfaceVTable handler = { walk, NULL, NULL, { 0 } };
	GDBusNodeInfo *info = g_dbus_node_info_new_for_xml(about, NULL);

	bus = connection;
	objects = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
	paths = g_hash_table_new_full(NULL, NULL, NULL, g_free);
	really_register(bus, "/rungboard/walk", info->interfaces[0], &handler, NULL, NULL, NULL);
}

guint g_dbus_connection_register_object(GDBusConnection *connection, const gchar *path, GDBusInterfaceInfo *info,
					const GDBusInterfaceVTable *handler, gpointer data, GDestroyNotify free_data,
					GError **error)
{
	const guint id = really_register(connection, path, info, handler, data, free_data, error);
	const bool accessible = !strcmp(info->name, ACCESSIBLE);
	struct object *object;

	if (!id || (!accessible && strcmp(info->name, COMPONENT) != 0))
		return id;
	if (!bus)
		begin(connection);
	object = g_hash_table_lookup(objects, path);
	if (!object) {
		object = g_new0(struct object, 1);
		g_hash_table_insert(objects, g_strdup(path), object);
	}
	if (accessible) {
		object->handler = handler;
		object->data = data;
		g_hash_table_insert(paths, GUINT_TO_POINTER(id), g_strdup(path));
	} else {
		object->widget = true;
	}
	return id;
}

gboolean g_dbus_connection_unregister_object(GDBusConnection *connection, guint id)
{
	static gboolean (*next)(GDBusConnection *, guint);
	const char *path = paths ? g_hash_table_lookup(paths, GUINT_TO_POINTER(id)) : NULL;

	if (path) {
		g_hash_table_remove(objects, path);
		g_hash_table_remove(paths, GUINT_TO_POINTER(id));
	}
	if (!next)
		*(void **)&next = original("g_dbus_connection_unregister_object");
	return next(connection, id);
}

/* Programs that the editor starts do not get it. */
__attribute__((constructor)) static void alone(void)
{
	g_unsetenv("LD_PRELOAD");
}
