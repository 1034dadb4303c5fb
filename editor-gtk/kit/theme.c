/* SPDX-License-Identifier: MIT
 *
 * theme - the token table; see theme.h. tests/editor/kit/test_theme.c computes the
 * contrast.
 */
#include "editor-gtk/kit/theme.h"

#include "editor-gtk/kit/settings.h"

#include <adwaita.h>

#define CONTRAST_HIGH 1 /* of the setting; 0: as the desktop                  */

#define HEX(rgb) { (float)((rgb) >> 16 & 0xff) / 255, (float)((rgb) >> 8 & 0xff) / 255, \
		   (float)((rgb) & 0xff) / 255, 1 }

/* A column of the table: sheet, ink, idle, power, force, error, accent, comment, badge,
 * blocks, gutter, line, found, the current one of what is found. */
#define COLORS(s, i, w, p, f, e, a, c, b, k, g, l, y, n) { \
	[TOKEN_SHEET] = HEX(s), [TOKEN_INK] = HEX(i), [TOKEN_IDLE] = HEX(w), \
	[TOKEN_POWER] = HEX(p), [TOKEN_FORCE] = HEX(f), [TOKEN_ERROR] = HEX(e), \
	[TOKEN_ACCENT] = HEX(a), [TOKEN_COMMENT] = HEX(c), [TOKEN_BADGE] = HEX(b), [TOKEN_BLOCKS] = HEX(k), \
	[TOKEN_GUTTER] = HEX(g), [TOKEN_LINE] = HEX(l), [TOKEN_FOUND] = HEX(y), \
	[TOKEN_FOUND_NOW] = HEX(n) }
#define SCREEN .idle_width = 1.5f, .power_width = 3, .shape_width = 2, .rail_width = 3

/* With blue power the accent is violet, so that no two meanings share a strong colour. */
static const struct theme table[THEME_KINDS][THEME_POWERS] = {
	[THEME_LIGHT] = {
		{ COLORS(0xffffff, 0x1d2125, 0x77767b, 0x0f8a4c, 0xb35c00, 0xc01c28,
			 0x1a5fb4, 0x5e5c64, 0xffffff, 0xa0197a, 0xf2f2f2, 0xe4e4e6, 0xf9f06b, 0xffd98a),
		  SCREEN, .fill = 0.16f, .wash = 0.14f },
		{ COLORS(0xffffff, 0x1d2125, 0x77767b, 0x1c6fd6, 0xb35c00, 0xc01c28,
			 0x813d9c, 0x5e5c64, 0xffffff, 0xa0197a, 0xf2f2f2, 0xe4e4e6, 0xf9f06b, 0xffd98a),
		  SCREEN, .fill = 0.16f, .wash = 0.14f },
	},
	[THEME_DARK] = {
		{ COLORS(0x1b1c1f, 0xf0f0f0, 0x8b8b92, 0x33d17a, 0xffa348, 0xff7b63,
			 0x78aeed, 0xb0afb5, 0x1b1c1f, 0xff8fd8, 0x222226, 0x303034, 0x3d3400, 0x553000),
		  SCREEN, .fill = 0.19f, .wash = 0.16f, .dark = true },
		{ COLORS(0x1b1c1f, 0xf0f0f0, 0x8b8b92, 0x62a0ea, 0xffa348, 0xff7b63,
			 0xdc8add, 0xb0afb5, 0x1b1c1f, 0xff8fd8, 0x222226, 0x303034, 0x3d3400, 0x553000),
		  SCREEN, .fill = 0.19f, .wash = 0.16f, .dark = true },
	},
	[THEME_CONTRAST] = {
		{ COLORS(0xffffff, 0x000000, 0x3d3d40, 0x00602c, 0x8a4000, 0x9a0010,
			 0x003c8c, 0x2a2a2d, 0xffffff, 0x7a0060, 0xffffff, 0x77767b, 0xf9f06b, 0xffd98a),
		  .idle_width = 2, .power_width = 4, .shape_width = 2.5f,
		  .rail_width = 4, .fill = 0.25f, .wash = 0.18f },
		{ COLORS(0xffffff, 0x000000, 0x3d3d40, 0x003c8c, 0x8a4000, 0x9a0010,
			 0x5c1f78, 0x2a2a2d, 0xffffff, 0x7a0060, 0xffffff, 0x77767b, 0xf9f06b, 0xffd98a),
		  .idle_width = 2, .power_width = 4, .shape_width = 2.5f,
		  .rail_width = 4, .fill = 0.25f, .wash = 0.18f },
	},
	[THEME_CONTRAST_DARK] = {
		{ COLORS(0x000000, 0xffffff, 0xc8c8cc, 0x57f29b, 0xffbe6f, 0xff9c8a,
			 0x99c9ff, 0xe0e0e3, 0x000000, 0xffb8ec, 0x000000, 0x8b8b92, 0x4a3e00, 0x683a00),
		  .idle_width = 2, .power_width = 4, .shape_width = 2.5f,
		  .rail_width = 4, .fill = 0.30f, .wash = 0.25f, .dark = true },
		{ COLORS(0x000000, 0xffffff, 0xc8c8cc, 0x99c9ff, 0xffbe6f, 0xff9c8a,
			 0xf0b3ff, 0xe0e0e3, 0x000000, 0xffb8ec, 0x000000, 0x8b8b92, 0x4a3e00, 0x683a00),
		  .idle_width = 2, .power_width = 4, .shape_width = 2.5f,
		  .rail_width = 4, .fill = 0.30f, .wash = 0.25f, .dark = true },
	},
#define PRINTED { COLORS(0xffffff, 0x000000, 0x000000, 0x000000, 0x000000, 0x000000, \
			 0x000000, 0x3d3d40, 0xffffff, 0x000000, 0xffffff, 0xb0b0b4, \
			 0xdededf, 0xc6c6c8), \
		  .idle_width = 1, .power_width = 2, .shape_width = 1.5f, \
		  .rail_width = 2, .fill = 0.15f, .wash = 0.10f }
	[THEME_PRINT] = { PRINTED, PRINTED },
};

const struct theme *theme_get(enum theme_kind kind, enum theme_power power)
{
	return &table[kind][power];
}

bool theme_is_high(void)
{
	return adw_style_manager_get_high_contrast(adw_style_manager_get_default()) ||
	       settings_enum("contrast", 0) == CONTRAST_HIGH;
}

enum theme_kind theme_kind_screen(void)
{
	const bool dark = adw_style_manager_get_dark(adw_style_manager_get_default());

	if (theme_is_high())
		return dark ? THEME_CONTRAST_DARK : THEME_CONTRAST;
	return dark ? THEME_DARK : THEME_LIGHT;
}

const struct theme *theme_screen(void)
{
	return theme_get(theme_kind_screen(), THEME_GREEN);
}

void theme_follow(gpointer object, GCallback changed)
{
	AdwStyleManager *manager = adw_style_manager_get_default();

	g_signal_connect_object(manager, "notify::dark", changed, object, G_CONNECT_SWAPPED);
	g_signal_connect_object(manager, "notify::high-contrast", changed, object,
				G_CONNECT_SWAPPED);
	if (settings_get())
		g_signal_connect_object(settings_get(), "changed::contrast", changed, object,
					G_CONNECT_SWAPPED);
}

void theme_call(gpointer data, GCallback changed)
{
	AdwStyleManager *manager = adw_style_manager_get_default();

	g_signal_connect_swapped(manager, "notify::dark", changed, data);
	g_signal_connect_swapped(manager, "notify::high-contrast", changed, data);
	if (settings_get())
		g_signal_connect_swapped(settings_get(), "changed::contrast", changed, data);
}

void theme_leave(gpointer data)
{
	g_signal_handlers_disconnect_by_data(adw_style_manager_get_default(), data);
	if (settings_get())
		g_signal_handlers_disconnect_by_data(settings_get(), data);
}

const char *token_name(enum token token)
{
	static const char *const name[TOKENS] = {
		"sheet", "ink", "idle", "power", "force", "error", "accent",
		"comment", "badge", "blocks", "gutter", "line", "found", "found-now",
	};

	return name[token];
}
