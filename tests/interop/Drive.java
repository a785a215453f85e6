// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
//
// Drives a robot with JavaClient 3 and shows its readings; other_languages.sh runs it.
import javaclient3.LaserInterface;
import javaclient3.PlayerClient;
import javaclient3.Position2DInterface;
import javaclient3.RangerInterface;
import javaclient3.SonarInterface;
import javaclient3.structures.PlayerConstants;

public class Drive {
  public static void main(String[] arguments) throws Exception {
    PlayerClient client = new PlayerClient(arguments[0], Integer.parseInt(arguments[1]));
    int open = PlayerConstants.PLAYER_OPEN_MODE;
    Position2DInterface position = client.requestInterfacePosition2D(0, open);
    LaserInterface laser = client.requestInterfaceLaser(0, open);
    SonarInterface sonar = client.requestInterfaceSonar(0, open);
    RangerInterface ranger = client.requestInterfaceRanger(0, open);
    // Not before the devices are opened: this client takes its answer for that of the next request.
    client.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
    client.runThreaded(-1, -1);
    position.queryGeometry();
    position.setMotorPower(1);
    position.setSpeed(0.3, 0.2);
    Thread.sleep(3000);
    position.setSpeed(0, 0);
    System.out.println("position: " + position.getX() + " " + position.getY() + " "
        + position.getYaw() + " length: " + position.getGeom().getSize().getSl());
    System.out.println("laser: " + laser.getData().getRanges_count() + " beams, "
        + laser.getData().getRanges()[0] + " m");
    System.out.println("sonar: " + sonar.getData().getRanges_count() + " ranger: "
        + ranger.getData().getRanges_count());
    client.close();
    System.exit(0);
  }
}
