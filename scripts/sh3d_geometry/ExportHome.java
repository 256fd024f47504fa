// Sweet Home 3D's own geometry of homes: each wall, room and piece of furniture as it draws them, as a named group of an OBJ file.
// java ExportHome.java HOME.sh3d HOME.obj [HOME.sh3d HOME.obj ...]; needs a display. Groups begin with "wall_3", "room_0", "piece_12": numbers in
// the order of Home.xml, groups of furniture unfolded. Lengths are centimetres, x and z those of the plan, y up.
import com.eteks.sweethome3d.io.DefaultUserPreferences;
import com.eteks.sweethome3d.io.HomeFileRecorder;
import com.eteks.sweethome3d.j3d.OBJWriter;
import com.eteks.sweethome3d.j3d.Object3DBranchFactory;
import com.eteks.sweethome3d.model.Home;
import com.eteks.sweethome3d.model.HomeFurnitureGroup;
import com.eteks.sweethome3d.model.HomePieceOfFurniture;
import com.eteks.sweethome3d.model.Level;
import com.eteks.sweethome3d.model.Room;
import com.eteks.sweethome3d.model.Selectable;
import com.eteks.sweethome3d.model.UserPreferences;
import com.eteks.sweethome3d.model.Wall;
import java.io.File;
import java.util.ArrayList;
import java.util.List;
import javax.media.j3d.Node;

public class ExportHome {
  private final Home home;
  private final Object3DBranchFactory factory;
  private final OBJWriter out;

  private ExportHome(Home home, UserPreferences preferences, File file) throws Exception {
    this.home = home;
    factory = new Object3DBranchFactory(preferences);
    out = new OBJWriter(file);
  }

  private static boolean isShown(Level level) {
    return level == null || level.isViewable();
  }

  private void write(Selectable thing, String name) throws Exception {
    // true: with models and textures loaded before it returns.
    out.writeNode((Node) factory.createObject3D(home, thing, true), name);
  }

  // Hidden ones too: they count in the numbers. What a group hides, its pieces do not say.
  private static void unfold(List<HomePieceOfFurniture> pieces, boolean shown, List<HomePieceOfFurniture> all, List<Boolean> visible) {
    for (HomePieceOfFurniture piece : pieces) {
      boolean here = shown && piece.isVisible() && isShown(piece.getLevel());
      if (piece instanceof HomeFurnitureGroup) {
        unfold(((HomeFurnitureGroup) piece).getFurniture(), here, all, visible);
      } else {
        all.add(piece);
        visible.add(here);
      }
    }
  }

  private void writeAll() throws Exception {
    home.getEnvironment().setAllLevelsVisible(true);
    int number = 0;
    for (Wall wall : home.getWalls()) {
      if (isShown(wall.getLevel())) write(wall, "wall_" + number);
      number++;
    }
    number = 0;
    for (Room room : home.getRooms()) {
      if (isShown(room.getLevel())) write(room, "room_" + number);
      number++;
    }
    List<HomePieceOfFurniture> pieces = new ArrayList<>();
    List<Boolean> visible = new ArrayList<>();
    unfold(home.getFurniture(), true, pieces, visible);
    for (int i = 0; i < pieces.size(); i++) {
      if (visible.get(i)) write(pieces.get(i), "piece_" + i);
    }
    out.close();
  }

  public static void main(String[] files) throws Exception {
    UserPreferences preferences = new DefaultUserPreferences();
    // The last two: Home.xml counts, not the Java objects beside it.
    HomeFileRecorder recorder = new HomeFileRecorder(0, false, preferences, false, true);
    for (int i = 0; i + 1 < files.length; i += 2) {
      new ExportHome(recorder.readHome(files[i]), preferences, new File(files[i + 1])).writeAll();
    }
    System.exit(0);  // Java 3D's threads live on
  }
}
