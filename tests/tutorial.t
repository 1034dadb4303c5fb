#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# tutorial.t - renders the pictures of docs/tutorial.md again from the rung files beside them.
# `make pictures` writes them. tests/editor/person/tutorial.py presses the keys of the tutorial.
#
# The widths of texts, and so the places of boxes, depend on the fonts of a machine. So only
# the content, style and line of texts are compared, and the order of horizontal places.
use strict;
use warnings;
use utf8;
use Cwd qw(abs_path);
use File::Basename qw(dirname basename);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $utf8 = ':encoding(UTF-8)';
my $top = abs_path(dirname(__FILE__) . '/..');
my $build = abs_path($ENV{BUILD} // "$top/build");
my $editor = "$build/ladder-editor";
my $folder = "$top/docs/tutorial";
plan skip_all => 'there is no ladder-editor' if !-x $editor;
$ENV{LC_ALL} = 'C.UTF-8';
$ENV{LANGUAGE} = '';
my $work = tempdir(CLEANUP => 1);

# Applies $place->() to each horizontal place of a tag; a width counts as the place of its
# right end.
sub with_places {
	my ($tag, $place) = @_;
	my $left = $tag =~ / x="([-.\d]+)"/ ? $1 : 0;
	$tag =~ s/( (?:x|x1|x2|cx)=")([-.\d]+)/$1 . $place->($2)/ge;
	$tag =~ s/( width=")([-.\d]+)/$1 . $place->($left + $2)/ge;
	$tag =~ s/( d="M| 0 0 1 )([-.\d]+)/$1 . $place->($2)/ge;
	return $tag;
}

# The content of a picture that does not depend on fonts.
sub shown {
	my ($svg) = @_;
	my (%rank, @lines);
	for (split /\n/, $svg) {
		s/ x="[^"]*"| textLength="[^"]*"//g if /^<text /;
		s/ (?:width|viewBox)="[^"]*"//g if /^<svg /;
		push @lines, $_;
		with_places($_, sub { $rank{sprintf '%.0f', $_[0]} = 0; return $_[0] }) if /^<[a-z]/;
	}
	my $count = 0;
	$rank{$_} = ++$count for sort { $a <=> $b } keys %rank;
	return join "\n", map { /^<[a-z]/ ? with_places($_, sub { $rank{sprintf '%.0f', $_[0]} }) : $_ } @lines;
}

sub rendered {
	my ($rung) = @_;
	my $path = "$work/picture.svg";
	unlink $path;
	system($editor, '--render', $rung, '-o', $path) == 0 or die "$rung is not drawn";
	return slurp($path, $utf8);
}

my $tutorial = slurp("$top/docs/tutorial.md", $utf8);
my %drawn;
for my $rung (glob("$folder/*.rung")) {
	my $name = basename($rung, '.rung');
	$drawn{$name} = slurp($rung, $utf8);
	is(shown(rendered($rung)), shown(slurp("$folder/$name.svg", $utf8)),
	   "$name.svg is $name.rung; if not: make pictures, and look at them");
	ok(index($tutorial, "](tutorial/$name.svg)") >= 0, "$name.svg is shown");
}
cmp_ok(scalar keys %drawn, '>=', 5, 'pictures were found');
is_deeply([map { basename($_, '.svg') } glob("$folder/*.svg")], [sort keys %drawn], 'each has its rung file');
# The results of both halves of the tutorial; tutorial.py draws them.
for my $name ('4-seal-in', 'fan') {
	ok(index($tutorial, $drawn{$name}) >= 0, "$name.rung is told in the tutorial");
}

# Tests the test: a changed program gives another picture.
my $seal = $drawn{'4-seal-in'};
my %other = (
	'an element' => $seal =~ s/NC Stop/NO Stop/r,
	'a name' => $seal =~ s/\bStop\b/Halt/gr,
	'an address' => $seal =~ s/%IX0\.1/%IX0.2/r,
	'where a branch ends' => $seal =~ s/NO Motor \^\|/NO Motor | --- ^|/r,
);
for my $what (sort keys %other) {
	isnt(shown(rendered(spew("$work/other.rung", $other{$what}, $utf8))), shown(slurp("$folder/4-seal-in.svg", $utf8)),
	     "$what is noticed");
}
done_testing();
