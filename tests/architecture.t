#!/usr/bin/env perl
# SPDX-License-Identifier: MIT
# architecture.t - every file, folder, function and make target that ARCHITECTURE.md names
# exists, and a function that is named beside a file stands in it.
#
# A file name is a path from the top, or below runtime/, runtime/engine/ or editor-gtk/, or
# the name of at least one file anywhere.
use strict;
use warnings;
use File::Find;
use FindBin;

chdir "$FindBin::Bin/.." or die;
my (%base, %defined, $sources);
find({ no_chdir => 1, wanted => sub {
	return if m{^\./(?:\.git|build)};
	(my $path = $_) =~ s{^\./}{};
	push @{ $base{$1} }, $path if m{([^/]+)\z};
	if (-f && /\.(?:c|h)\z/ && !m{^\./tests/}) {
		open my $in, '<', $_ or die "$_: $!";
		local $/;
		my $code = <$in>;
		$sources .= $code;
		# Definitions, macros; in a header all that it declares.
		$defined{$1}{$path} = 1 while $code =~ /^[A-Za-z_][^;{}()=\n]*?\b(\w+)\([^;{}()]*(?:\([^;{}()]*\)[^;{}()]*)*\)\s*\{/mg;
		$defined{$1}{$path} = 1 while $code =~ /^#define (\w+)\(/mg;
		if ($path =~ /\.h$/) { $defined{$1}{$path} = 1 while $code =~ /\b(\w+)\(/g }
	}
} }, '.');
open my $make, '<', 'Makefile' or die;
my $makefile = do { local $/; <$make> };
open my $page, '<', 'ARCHITECTURE.md' or die;
my $text = do { local $/; <$page> };
$text =~ s/^```.*?^```//gms;

my ($n, $failed, $pairs, $walked, %seen) = (0, 0, 0, 0);
sub check {
	my ($good, $name) = @_;

	printf "%sok %d - %s\n", $good ? "" : "not ", ++$n, $name;
	$failed ||= !$good;
}
sub found {
	my ($path) = @_;

	for my $top ('', 'runtime/', 'runtime/engine/', 'editor-gtk/', 'tests/') {
		my ($hit) = glob("$top$path");
		return $hit if defined $hit && -e $hit;
	}
	return $path !~ m{/} && $base{$path} ? $base{$path}[0] : undef;
}
sub stands_in {
	my ($function, $file) = @_;
	my $path = found($file);

	return if !$path || $file =~ /\.h$/ || $function =~ /_X$/ || $seen{"$function $path"}++;
	check($defined{$function}{$path}, "$function() stands in $file");
	$pairs++;
}
while ($text =~ /`([^`\n]+)`/g) {
	my $said = $1;

	for my $name (split / /, $said) {
		next if $seen{$name}++ || $name =~ /NAME|LANG|\bX\b|_X/;
		if ($name =~ /^(\w+)\(\)$/) {
			my $function = $1;
			check($defined{$function}, "function $name");
		} elsif ($name =~ m{^[\w.*/-]+(?:\.(?:c|h|def|sh|t|pl|py|md|ui)|/)$}) {
			check(found($name), "file $name");
		}
	}
	if ($said =~ /^make ([a-z-]+)$/ && !$seen{$said}++) {
		my $target = $1;
		check(scalar($makefile =~ /^\Q$target\E:/m), $said);
	}
	check(scalar($sources =~ /\b\Q$said\E\b/), $said)
		if $said =~ /^(?:struct|enum) \w+$/ && !$seen{$said}++;
}
# `function()` (`file`), or in, of, from the file; `file`, `function()`.
stands_in($1, $2) while $text =~ /`(\w+)\(\)`(?:,? \(|,? in |,? of |,\s)\s*`([\w.\/-]+\.[ch])`/g;
stands_in($2, $1) while $text =~ /`([\w.\/-]+\.[ch])`,\s+`(\w+)\(\)`/g;
# In the walks each function is beside its file, or stands in the one that was named last.
my ($walks) = $text =~ /^## Two walks(.*?)^## /ms or die;
for my $step (split /^(?=\d+\. )/m, $walks) {
	my $last;
	while ($step =~ /`(\w+)\(\)`(?:\s+\(`([\w.\/-]+\.[ch])`)?|`([\w.\/-]+\.[ch])`/g) {
		$last = $2 // $3 if $2 || $3;
		next unless $1;
		$walked++;
		$last ? stands_in($1, $last) : check(0, "$1() has no file in the walks");
	}
}
check($walked > 50, "it followed the walks ($walked functions)");
check($pairs > 20, "it found functions beside files ($pairs of them)");
check($n > 100, "it found the names ($n of them)");
print "1..$n\n";
exit $failed;
