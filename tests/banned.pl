#!/usr/bin/env perl
# SPDX-License-Identifier: MIT
# banned - checks the rules of the house on the sources; a TAP line for each rule.
#
# It reads text, not syntax: rules about code ignore comments and strings. Tests follow the
# rules of heading and layout, but not those of calls.
use strict;
use warnings;
use File::Find;
use FindBin;

chdir($ENV{BANNED_ROOT} // "$FindBin::Bin/..") or die;
my (@files, $n, $failed);
find({ no_chdir => 1, wanted => sub {
	push @files, $_ if -f && /\.(c|h|def)$/;
} }, grep { -d } qw(runtime hal editor-gtk tests));
@files = sort @files;

# The first two bytes of a file.
sub read_first {
	my $first = '';
	open my $in, '<', $_[0] or return '';
	read $in, $first, 2;
	return $first;
}

sub say_rule {
	my ($text, @bad) = @_;

	$n++;
	printf "%sok %d - %s\n", @bad ? "not " : "", $n, $text;
	print "#   $_\n" for @bad;
	$failed = 1 if @bad;
}

my (%text, %code);
for my $file (@files) {
	open my $in, '<:raw', $file or die "$file: $!";
	local $/;
	$text{$file} = <$in>;
	my $code = $text{$file};
	# Removes comments and strings, keeps lines.
	$code =~ s{(/\*.*?\*/|//[^\n]*|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')}
		{my $x = $1; my $q = substr($x, 0, 1);
		 $x =~ s/[^\n]//g; $q eq '"' ? qq("$x") : $q eq "'" ? "0$x" : " $x"}gse;
	$code{$file} = $code;
}

# The places in the code of selected files where a pattern matches.
sub places {
	my ($pattern, $choose) = @_;
	my @bad;

	for my $file (grep { $choose->($_) } @files) {
		my $line = 0;
		for (split /\n/, $code{$file}) {
			$line++;
			push @bad, "$file:$line: $1" if /($pattern)/;
		}
	}
	return @bad;
}

my $house = sub { $_[0] !~ m{^tests/} };
my $library = sub { $_[0] =~ m{^runtime/engine/} };
my $all = sub { 1 };

say_rule("no unbounded string functions",
	 places(qr/\b(?:strcpy|strcat|sprintf|vsprintf|gets|strtok|stpcpy|scanf|sscanf|fscanf)\s*\(/, $all));
say_rule("no atoi and its kind",
	 places(qr/\b(?:atoi|atol|atoll|atof)\s*\(/, $house));
say_rule("no alloca", places(qr/\balloca\s*\(/, $all));
say_rule("no typedef of a struct or enum",
	 places(qr/\btypedef\s+(?:struct|enum|union)\b/, $house));
say_rule("the library does not print or exit",
	 places(qr/\b(?:printf|puts|putchar|perror|exit|_exit|abort|system|popen|fork)\s*\(/, $library));
say_rule("the scan reads no clock, takes no lock, allocates nothing",
	 places(qr/\b(?:clock_gettime|gettimeofday|time|malloc|calloc|realloc|free|pthread_\w+|fopen|write|read)\s*\(/,
		sub { $_[0] =~ m{^runtime/engine/scan/} }));
# A message may have another text in the build for small boards.
my %coded;
$coded{$2}{$1} = 1 while $text{'runtime/engine/diag.def'} =~ /^DIAG\((\w+),\s*"(\w+)"/gm;
say_rule("each message has a code of its own", grep { keys %{$coded{$_}} > 1 } sort keys %coded);
# Its own printf (ladderd/print_static.c) has only these.
say_rule("what a board prints has only d i u x X o c s, no floating point", map {
	my $file = $_;
	map { "$file: $_" } grep { !/^%[-0]*(?:\d+|\*)?(?:\.(?:\d+|\*))?(?:hh|h|ll|l|z)?[diuxXocs]$/ }
		map { /(%[-+ #0-9.*]*(?:hh|h|ll|l|z|j|t|L)?[a-zA-Z])/g } map { s/%%//gr }
		$text{$file} =~ /(?:printf|diag_add|tell|add|say)\w*\s*\([^;]*?("(?:[^"\\\n]|\\.)*")/g
} grep { m{^(?:hal|runtime/(?:ladderd|online|engine/(?:base|scan|model|text|check|translate)))/.*\.c$} } @files);
# The size of long differs between boards.
say_rule("the scan's numbers are of one size everywhere",
	 places(qr/\b(?:long|wchar_t|time_t|intmax_t|ptrdiff_t)\b/,
		sub { $_[0] =~ m{^runtime/engine/scan/} }));
# libiio alone is loaded at need, by its name.
say_rule("no fork, no dlopen on a board",
	 places(qr/\b(?:fork|vfork|dlopen|mprotect|execv\w*|execl\w*)\s*\(/,
		sub { $_[0] =~ m{^(?:runtime/engine/base|runtime/engine/scan|hal|runtime/ladderd)/} &&
		      $_[0] ne 'hal/iio_calls.c' }));
# A handler that replaces widgets while GTK moves the focus may remove the one that gets it. The exceptions hear
# of the enter, or let go of a key, and change no widget.
my %focus = map { ("editor-gtk/$_" => 1) } qw(kit/left.c window/below_part.c live/sim_panel.c);
say_rule("only kit/left.c hears of a focus that leaves",
	 places(qr/\bgtk_event_controller_focus_new\s*\(/,
		sub { $_[0] =~ m{^editor-gtk/} && !$focus{$_[0]} }),
	 map { my $ui = $_; open my $in, '<', $ui or die "$ui: $!"; local $/;
	       <$in> =~ /GtkEventControllerFocus/ ? $ui : () } glob('editor-gtk/ui/*.ui'));
# The engine compares names by Unicode: base/name.h. A call with a word in quotes compares a
# keyword; these files compare keywords in tables and file endings only.
my %keywords = map { ("editor-gtk/$_" => 1) } qw(document/classic.c document/csv.c draw/pages.c
	window/usage.c);
say_rule("the editor compares names as the engine does",
	 grep { !/""/ }
	 places(qr/\b(?:g_ascii_strn?casecmp|strn?casecmp|strcasestr|g_ascii_(?:strdown|strup|tolower|toupper)|tolower|toupper)\s*\(.*/,
		sub { $_[0] =~ m{^editor-gtk/} && !$keywords{$_[0]} }));

say_rule("every source says its licence on its first line",
	 grep { (split /\n/, $text{$_})[0] !~ /SPDX-License-Identifier: \S+/ }
	 grep { !m{^tests/hal/fake_v} } @files);
say_rule("every source opens with why it exists",
	 grep { $text{$_} !~ m{\A/\*\s*SPDX[^\n]*(?:\*/\s*/\*|\n \*\n \*)\s*\S} } @files);
say_rule("no blanks at line ends",
	 map { my $f = $_; my $l = 0;
	       map { $l++; /[ \t]$/ ? "$f:$l" : () } split /\n/, $text{$f} } @files);
say_rule("tabs indent",
	 map { my $f = $_; my $l = 0;
	       map { $l++; /^ {8}/ ? "$f:$l" : () } split /\n/, $code{$f} }
	 grep { !/\.def$/ } @files);
say_rule("no unnamed TODO",
	 map { my $f = $_; my $l = 0;
	       map { $l++; /\b(?:TODO|FIXME|XXX)\b/ ? "$f:$l" : () }
	       split /\n/, $text{$f} } @files);

# A public function is one that is defined without static. The program must use it: a test
# alone does not count. It is static if only its own file and no test names it. Names that
# macros make of rows (fn_##id) count as used, and so do those that the linker calls (__wrap_…).
my (%public, %pasted, %named);
sub read_head {
	my ($file, $before, $name, $behind, $end) = @_;

	$public{$name} = $file if $house->($file) && $file =~ /\.c\z/ && $end eq '{';
	return $before . $behind . $end;
}
for my $file (@files) {
	my $rest = $code{$file};
	my %static = map { ($_ => 1) } $rest =~ /^static\b[^;{}()=]*?\b(\w+)\s*\([^;{}]*\)\s*[;{]/gm;

	if ($house->($file)) {
		$pasted{$1 . '\w+' . ($2 // '')} = 1 while $rest =~ /\b([a-z]\w\w+)##\w+(?:##(\w+))?/g;
	}
	# Heads of functions, and declarations, name a function but do not use it.
	$rest =~ s/(?<!\)\n)^(?!static\b|typedef\b|return\b|else\b|#)([A-Za-z_]\w*\b[^;{}()=]*?)\b(\w+)(\s*\([^;{}]*?\)\s*)([;{])/
		read_head($file, $1, $2, $3, $4)/gsme;
	while ($rest =~ /\b([A-Za-z_]\w+)\b/g) {
		$named{$1}{$file} = 1 if !$static{$1};
	}
}
my $made = join '|', sort keys %pasted;
my (@unused, @lone);
for my $name (grep { !/^(?:main|__wrap_\w+|$made)$/ } sort keys %public) {
	my @by = keys %{ $named{$name} // {} };

	if (!grep { $house->($_) } @by) {
		push @unused, "$public{$name}: $name";
	} elsif (!grep { $_ ne $public{$name} } @by) {
		push @lone, "$public{$name}: $name";
	}
}
say_rule("the program uses every public function", @unused);
say_rule("what one file uses is static", @lone);

# A function begins with a line at the margin, followed by `{` at the margin.
my @long;
for my $file (grep { /\.c$/ } @files) {
	my ($line, $start, $name, $last) = (0, 0, "", "");
	for (split /\n/, $code{$file}) {
		$line++;
		$last = $1 if /^\w[^;]*?(\w+)\(/;
		($start, $name) = ($line, $last) if /^\{/;
		if (/^\}/ && $start) {
			my $size = $line - $start - 1;
			push @long, "$file:$start: $name: $size lines"
				if $size > 80 && !($file =~ m{scan/vm\.c$});
			$start = 0;
		}
	}
}
say_rule("no function is longer than 80 lines", @long);

my @ifdef;
for my $file (grep { /\.c$/ && $house->($_) } @files) {
	my ($line, $inside) = (0, 0);
	for (split /\n/, $code{$file}) {
		$line++;
		$inside = 1 if /^\{/;
		$inside = 0 if /^\}/;
		push @ifdef, "$file:$line" if $inside && /^\s*#\s*if/;
	}
}
say_rule("no #ifdef inside a function", @ifdef);

my @path;
for my $file (@files) {
	my $line = 0;
	for (split /\n/, $text{$file}) {
		$line++;
		push @path, "$file:$line" if m{/work/|/home/\w|\.\./shared};
	}
}
say_rule("no path of somebody's machine", @path);

# The comment of every public function of scan/ must have *Scan-safe*.
my @safe;
for my $file (grep { m{^runtime/engine/scan/.*\.h$} } @files) {
	while ($text{$file} =~ m{/\*\*(.*?)\*/}gs) {
		my $comment = $1;
		my $line = 1 + (substr($text{$file}, 0, $-[0]) =~ tr/\n//);
		push @safe, "$file:$line" if $comment !~ /Scan-safe|live[s]? (?:for ever|with)/i
			&& $comment =~ /^\s*\*?\s*\w+ -/ && $comment =~ /\n/;
	}
}
say_rule("public functions of scan/ say whether a scan may call them", @safe);

# prove cannot start any other file with #!.
my @scripts = glob 'tests/*.t tests/*.sh tests/*.pl tests/hal/*.t tests/editor/person/*.py';
say_rule("scripts are executable", grep { !-x $_ && read_first($_) eq '#!' } @scripts);

print "1..$n\n";
exit($failed ? 1 : 0);
