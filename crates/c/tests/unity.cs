// MediantGrid.cs, outside of Unity: with Mono, whose runtime Unity has, too.
using System;
using System.Diagnostics;
using System.Linq;
using System.Threading;

static class Program
{
    static void Is(bool holds, string text)
    {
        if (holds) return;
        Console.Error.WriteLine("unity.cs: " + text);
        Environment.Exit(1);
    }

    // A wall with a door at (31, 20), in a map of 64 × 64 cells.
    static byte[] Walled()
    {
        var cells = new byte[64 * 64];
        for (int y = 0; y < 64; y++) cells[y * 64 + 31] = 1;
        cells[20 * 64 + 31] = 0;
        return cells;
    }

    static string Shown(GridPoint[] points, int count) =>
        string.Join(" ", points.Take(count).Select(point => $"{point.X},{point.Y}"));

    static void Paths()
    {
        using (var grid = new MediantGrid(64, 64, Walled(), "neighbors=4"))
        {
            // Grows.
            var points = new GridPoint[1];
            int count = grid.Path(new GridPoint(10, 20), new GridPoint(50, 20), ref points, out double length);
            Is(Shown(points, count) == "10,20 50,20" && length == 40, "a way through the door");
            grid.Edit(new GridArea { X = 31, Y = 20, Width = 1, Height = 1 }, new byte[] { 1 });
            count = grid.Path(new GridPoint(10, 20), new GridPoint(50, 20), ref points, out length);
            Is(count == 0 && double.IsInfinity(length), "no way where the door is shut");
            count = grid.Find(new GridPoint(10, 20), new GridPoint(50, 20), ref points);
            Is(Shown(points, count) == "10,20 30,20", "the nearest place is before the door");
            // In the wall, and moved out of it.
            count = grid.Find(new GridPoint(10, 20), new GridPoint(31, 5), ref points);
            Is(count > 1 && points[count - 1].X == 30, "an end in the wall");
            grid.Edit(new GridArea { X = 31, Y = 0, Width = 1, Height = 2 }, new byte[] { 0, 0 });
            count = grid.Path(new GridPoint(10, 20), new GridPoint(50, 20), ref points, out length);
            Is(length == 40 + 2 * 19, "another door");
        }
    }

    static void Mistakes()
    {
        using (var grid = new MediantGrid(64, 64, Walled()))
        {
            var points = new GridPoint[4];
            try
            {
                grid.Path(new GridPoint(31, 5), new GridPoint(3, 3), ref points, out double _);
                Is(false, "a blocked start is no mistake");
            }
            catch (MediantException mistake)
            {
                Is(mistake.Code == 13 && mistake.Message.Contains("31"), "it says: " + mistake.Message);
            }
        }
        try
        {
            new MediantGrid(64, 64, Walled(), "k=seven").Dispose();
            Is(false, "k=seven is no mistake");
        }
        catch (MediantException mistake)
        {
            Is(mistake.Message.Contains("seven"), "it says: " + mistake.Message);
        }
    }

    static void Main()
    {
        Paths();
        Mistakes();
        var threads = Enumerable.Range(0, 4).Select(_ => new Thread(Paths)).ToArray();
        foreach (var thread in threads) thread.Start();
        foreach (var thread in threads) thread.Join();
        using (var grid = new MediantGrid(64, 64, Walled(), "k=any gap=closed"))
        {
            var points = new GridPoint[64];
            const int Times = 100000;
            var watch = Stopwatch.StartNew();
            for (int i = 0; i < Times; i++)
                grid.Path(new GridPoint(10, 10), new GridPoint(50.5, 20.25), ref points, out double _);
            Console.WriteLine($"unity.cs: all is as it should be; {watch.ElapsedMilliseconds * 1e6 / Times:F0} ns a path");
        }
    }
}
